#pragma once

#include "accel/algebra/expression.h"
#include "accel/core/registry.h"

/// Compositions that tests try: of every technique based on spatial indexing, in every place, and of many that are not.
namespace rayshoot {

inline constexpr const char* kExpressions[] = {
    "uniform_grid|exhaustive",
    "uniform_grid|uniform_grid",
    "uniform_grid(resolution=3x3x3)|bvh_sah",
    "uniform_grid(storage=hashed)|kd_tree",
    "uniform_grid(assignment=exact)|uniform_grid",
    "recursive_grid|octree_samet(max_depth=2)",
    "hug|bvh_goldsmith_salmon",
    "adaptive_grid|uniform_grid",
    "octree_glassner(max_depth=2)|uniform_grid",
    "octree_samet(max_depth=2)|bvh_kay_kajiya",
    "octree_gargantini(max_depth=2)|recursive_grid",
    "octree_dda(max_depth=2)|grid_1d",
    "octree_revelles(max_depth=2)|uniform_grid(density=2)",
    "octree_revelles(max_depth=2,assignment=surface)|octree_dda(max_depth=2)",
    "bsp_kaplan(max_depth=4)|bvh_rubin_whitted",
    "bsp_jansen(max_depth=4)|bounding_volumes",
    "kd_tree(max_depth=4)|octree_revelles",
    "kd_tree(max_depth=3,clipped=off)|bvh_weghorst",
    "bvh_sah(max_objects=32)|uniform_grid",
    "bvh_wide|bvh_wide(max_objects=2)",
    "uniform_grid(resolution=2x2x2)|octree_samet(max_depth=1)|bvh_sah",
    "uniform_grid(resolution=2x2x2)|(octree_samet(max_depth=1)|bvh_sah)",
    "octree_revelles(max_depth=1)|kd_tree(max_depth=2)|hug|uniform_grid",
    "sequential(uniform_grid,bvh_sah,until=0,box=voxel)",
    "sequential(uniform_grid,uniform_grid,until=1,box=objects)",
    "sequential(bsp_jansen(max_depth=3),adaptive_grid,box=objects)",
    "uniform_grid||octree_revelles",
    "bvh_sah||uniform_grid",
    "bvh_kay_kajiya||bounding_volumes",
    "kd_tree||bvh_goldsmith_salmon||hug",
    "exhaustive||grid_1d",
    "uniform_grid|bvh_sah||octree_dda(max_depth=2)|uniform_grid",
    "uniform_grid(resolution=2x2x2)|(bvh_sah||octree_samet)",
    "recursive(uniform_grid(resolution=2x2x2),max_depth=4)",
    "recursive(uniform_grid(resolution=2x1x1),until=4,max_depth=5)",
    "recursive(bsp_kaplan(max_depth=2),until=2,max_depth=3)",
    "recursive(octree_dda(max_depth=1),box=fit)",
    "recursive(uniform_grid(density=1),max_depth=3)||recursive(bvh_sah,max_depth=2)",
    "octree_revelles(max_depth=1)|recursive(uniform_grid(resolution=2x2x2),max_depth=3)",
};

inline Expression parsed(std::string_view text) { return parse_expression(text, technique_entries()); }

/// The compositions as entries like those of the registry.
inline const std::vector<const TechniqueEntry*>& composed_entries() {
  static const std::vector<TechniqueEntry> entries = [] {
    std::vector<TechniqueEntry> all;
    for (const char* text : kExpressions) all.push_back(compose(parsed(text)));
    return all;
  }();
  static const std::vector<const TechniqueEntry*> pointers = [] {
    std::vector<const TechniqueEntry*> all;
    for (const TechniqueEntry& entry : entries) all.push_back(&entry);
    return all;
  }();
  return pointers;
}

}  // namespace rayshoot
