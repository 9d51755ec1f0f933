// Volumes guided by an octree are tight and disjoint (Glassner 1988; Arvo & Kirk §12).
#include <gtest/gtest.h>

#include "accel/core/technique_optimizer.h"
#include "accel/tests/built_engine.h"
#include "accel/tests/conformance.h"
#include "scenes/io/load_scene.h"

namespace rayshoot {
namespace {

struct Leaf {
  Box<double> box;
  std::vector<std::uint32_t> objects;
};

std::vector<Leaf> leaves(const Geometry<double>& geometry, const char* id, const Given& given = {}) {
  const TechniqueEntry& entry = technique_entry(id);
  const auto optimizer =
      entry.build_optimizer<double>({geometry}, Arguments(entry.info.parameters, given, id));
  std::vector<Leaf> leaves;
  optimizer->index()->for_each_voxel([&](const Voxel<double>& voxel) {
    leaves.push_back({voxel.box, {voxel.objects.begin(), voxel.objects.end()}});
  });
  return leaves;
}

double volume(const Box<double>& box) {
  const Vec3d e = box.empty() ? Vec3d{} : box.extent();
  return e.x * e.y * e.z;
}

/// The space that two leaves share, summed over all pairs.
double shared_volume(const std::vector<Leaf>& leaves) {
  double sum = 0;
  for (std::size_t i = 0; i < leaves.size(); ++i)
    for (std::size_t j = 0; j < i; ++j)
      sum += volume({max(leaves[i].box.lo, leaves[j].box.lo), min(leaves[i].box.hi, leaves[j].box.hi)});
  return sum;
}

class GlassnerHybrid : public ::testing::TestWithParam<const char*> {
 protected:
  Geometry<double> geometry_{load_scene(GetParam()).scene};
};

TEST_P(GlassnerHybrid, HasLeavesThatAreDisjointAsThoseOfVolumesAreNot) {
  EXPECT_EQ(shared_volume(leaves(geometry_, "glassner_hybrid")), 0);
  EXPECT_GT(shared_volume(leaves(geometry_, "bvh_sah")), 0);
}

TEST_P(GlassnerHybrid, HasLeavesThatAreTightAsThoseOfAnOctreeAreNot) {
  const Given limits{{"max_depth", "4"}};
  double whole = 0;
  for (const Leaf& leaf : leaves(geometry_, "glassner_hybrid", limits)) {
    // No smaller box holds what of the objects' bounds is inside.
    Box<double> inside;
    for (const std::uint32_t object : leaf.objects) {
      const Box<double> bounds = geometry_.bounds(object);
      inside.include(Box<double>{max(bounds.lo, leaf.box.lo), min(bounds.hi, leaf.box.hi)});
    }
    EXPECT_EQ(inside, leaf.box);
    whole += volume(leaf.box);
  }
  double cells = 0;
  for (const Leaf& leaf : leaves(geometry_, "octree_revelles", {{"max_depth", "4"}, {"assignment", "box"}}))
    cells += volume(leaf.box);
  EXPECT_LT(whole, 0.95 * cells);
}

/// So rays have fewer candidates than in the octree that guided it.
TEST_P(GlassnerHybrid, HasFewerCandidatesThanItsOctree) {
  const auto rays = nasty::rays(geometry_, 1, 300);
  const auto tests = [&](const char* id, const Given& given) {
    return counted(*build(id, geometry_, given), Query::closest, rays).work.distinct_objects;
  };
  EXPECT_LT(tests("glassner_hybrid", {}), tests("octree_revelles", {{"assignment", "box"}}));
}

INSTANTIATE_TEST_SUITE_P(Scenes, GlassnerHybrid, ::testing::Values("balls:2", "tree:5", "gears:1", "lumpy:2"),
                         [](const auto& scene) {
                           const std::string spec = scene.param;
                           return spec.substr(0, spec.find(':'));
                         });

}  // namespace
}  // namespace rayshoot
