// Lists, grids and objects, nested at will
// J. M. Snyder & A. H. Barr, "Ray tracing complex models containing surface tessellations", Computer Graphics 21(4), 1987.
//
// Idea       A list and a grid hold objects, and both are objects: so lists are in grids, grids in grids, and either in any
//            number of places at once, by a transformation. What is nested in what is the modeller's choice: each part that
//            is placed in a scene, and the scene itself, is a list where it has few objects and a grid where it has more.
// Parameters lists (8)    so many objects at the most make a list
//            density (5)  cells per object of a grid, as uniform_grid
// Cost       that of a uniform grid or a list for each placed part on the way of the ray.
// Weak       without placed parts it is a uniform grid.

#include <fmt/format.h>

#include "accel/algebra/define_composition.h"

namespace rayshoot {

const TechniqueEntry& technique_snyder_barr() {
  static const TechniqueEntry entry = define_composition(
      {.id = "snyder_barr",
       .title = "Lists and grids of objects, lists and grids",
       .family = "composed",
       .survey_section = "12",
       .paper = "Snyder & Barr 1987",
       .parameters = {integer_parameter("lists", 8, 0, 1e6, "so many objects at the most make a list"),
                      real_parameter("density", 5, 0.01, 1000, "cells per object of a grid")}},
      1, [](const Arguments& arguments, std::uint32_t objects) -> std::string {
        if (objects <= arguments.integer("lists")) return "exhaustive";
        return fmt::format("uniform_grid(density={})", arguments.real("density"));
      });
  return entry;
}

}  // namespace rayshoot
