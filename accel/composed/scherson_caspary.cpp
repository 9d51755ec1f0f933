// Octree on top, hierarchies of bounding volumes below
// I. D. Scherson & E. Caspary, "Data structures and the time complexity of ray tracing", The Visual Computer 3, 1987.
//
// Idea       Octrees do well where the first hit is near the edge of the scene, for a ray ends after few voxels; bounding
//            volumes do well deep inside, where an octree breaks objects up and walks through many voxels. So the upper
//            levels are an octree, and in each of its leaves a hierarchy of Kay and Kajiya holds the objects. This is the
//            sequential composition octree|bvh_kay_kajiya of Revelles and Ureña.
// Parameters max_depth (3)     divisions of the octree: 512 leaves, in each of which a hierarchy pays
//            max_objects (64)  an octree leaf with at most so many is not divided again
//            until (8)         a leaf with at most so many keeps its plain list
//            plane_sets (3)    of the slabs: three make boxes, which are cheapest
//            Objects are assigned to octree leaves by their bounds, so that a hierarchy need not reach beyond its leaf.
// Cost       that of a shallow octree, and in each leaf on the ray that of a small hierarchy.
// Weak       An object in several leaves is in several hierarchies.

#include <fmt/format.h>

#include "accel/algebra/define_composition.h"

namespace rayshoot {

const TechniqueEntry& technique_scherson_caspary() {
  static const TechniqueEntry entry = define_composition(
      {.id = "scherson_caspary",
       .title = "Octree of bounding volume hierarchies",
       .family = "composed",
       .survey_section = "12",
       .paper = "Scherson & Caspary 1987",
       .parameters = {integer_parameter("max_depth", 3, 1, 8, "divisions of the octree at the most"),
                      integer_parameter("max_objects", 64, 1, 1e6,
                                        "an octree leaf with at most so many objects is not divided again"),
                      integer_parameter("until", 8, 0, 1e9,
                                        "an octree leaf with at most so many objects keeps its plain list"),
                      choice_parameter("plane_sets", "3", {"3", "5", "7", "9", "13"},
                                       "slabs of the bounding volumes")}},
      2, [](const Arguments& arguments, std::uint32_t) {
        return fmt::format(
            "sequential(octree_revelles(max_depth={},max_objects={},assignment=box),bvh_kay_kajiya(plane_"
            "sets={}),until={})",
            arguments.integer("max_depth"), arguments.integer("max_objects"), arguments.text("plane_sets"),
            arguments.integer("until"));
      });
  return entry;
}

}  // namespace rayshoot
