// What makes octree_revelles that technique: every leaf that the ray meets, no other, and no way twice from the root.
#include <set>

#include "accel/tests/leaf_sequence.h"

namespace rayshoot {
namespace {

constexpr const char* kOctree = "octree_revelles";

/// Leaves, and the interior nodes above them, whose closed interval on a ray is not empty, found by asking all.
struct Met {
  std::uint64_t nodes = 0, leaves = 0, empty_leaves = 0;
  std::set<std::uint32_t> objects;
};

Met met_by(const Octree<double>& octree, const Ray<double>& ray) {
  Met met;
  octrees::for_each_met(octree, ray, [&](const Octree<double>::Node& node) {
    ++met.nodes;
    if (node.interior()) return;
    ++met.leaves;
    met.empty_leaves += node.count == 0;
    for (const std::uint32_t object : octree.objects(node)) met.objects.insert(object);
  });
  return met;
}

TEST(OctreeRevelles, VisitsEveryLeafThatTheRayMeetsAndNoOther) {
  const Geometry<double> geometry(soup_scene(200));
  const Octree<double> octree = build_octree(geometry, octrees::kLimits);
  const auto engine = build(kOctree, geometry, octrees::kGiven);
  const auto scratch = engine->scratch();
  std::uint64_t leaves = 0;
  for (const Ray<double>& ray : octrees::rays_through(geometry, octree.lattice)) {
    if (!(ray.t_min <= ray.t_max)) continue;
    const Met met = met_by(octree, ray);
    const Work work = counted(*engine, Query::strict, {ray}).work;
    ASSERT_EQ(work.cells, met.leaves) << conformance::describe(ray);
    ASSERT_EQ(work.empty_cells, met.empty_leaves) << conformance::describe(ray);
    ASSERT_EQ(work.steps, met.nodes) << "each node on the ray is entered once; "
                                     << conformance::describe(ray);
    const auto candidates = engine->candidates(Query::strict, ray, *scratch);
    ASSERT_TRUE(std::equal(candidates.begin(), candidates.end(), met.objects.begin(), met.objects.end()))
        << conformance::describe(ray);
    leaves += met.leaves;
  }
  EXPECT_GT(leaves, 5000u);
}

/// The same tree as octree_glassner's, the same objects met, and fewer steps, for none begins at the root again.
TEST(OctreeRevelles, TakesFewerStepsThanNamingEveryVoxelFromTheRoot) {
  const Geometry<double> geometry(soup_scene(400));
  const auto rays = nasty::rays(geometry, 1, 200);
  const auto named = build("octree_glassner", geometry), parametric = build(kOctree, geometry);
  const StructureStats of_named = named->structure(), own = parametric->structure();
  EXPECT_EQ(own.nodes, of_named.nodes);
  EXPECT_EQ(own.empty_leaves, of_named.empty_leaves);
  EXPECT_EQ(own.references, of_named.references);
  const Work by_name = counted(*named, Query::strict, rays).work,
             by_parameter = counted(*parametric, Query::strict, rays).work;
  EXPECT_LE(by_parameter.distinct_objects, by_name.distinct_objects);
  EXPECT_LT(by_parameter.steps, by_name.steps);
}

}  // namespace
}  // namespace rayshoot
