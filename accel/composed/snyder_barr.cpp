// Lists, grids and objects, nested at will
// J. M. Snyder & A. H. Barr, "Ray tracing complex models containing surface tessellations", Computer Graphics 21(4), 1987.
//
// Idea       A list and a grid hold objects, and both are objects: so lists are in grids, grids in grids, and either in any
//            number of places at once, by a transformation. A few objects make a list, more a grid, and a crowded cell
//            another grid; a part of a scene that is placed many times gets its own, once.
// Parameters lists (8)       so many objects at the most make a list
//            density (5)     cells per object of a grid, as uniform_grid
//            max_depth (2)   grids one in another within a part; they nested what they modelled, no deeper
// Cost       that of a uniform grid for each part on the way of the ray.
// Weak       without placed parts it is a grid of grids, which octrees and hierarchies beat where objects differ in size.

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
                      real_parameter("density", 5, 0.01, 1000, "cells per object of a grid"),
                      integer_parameter("max_depth", 2, 1, 8, "grids one in another within a part")}},
      2, [](const Arguments& arguments) {
        return fmt::format("recursive(uniform_grid(density={}),until={},max_depth={})",
                           arguments.real("density"), arguments.integer("lists"),
                           arguments.integer("max_depth"));
      });
  return entry;
}

}  // namespace rayshoot
