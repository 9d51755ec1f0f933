// The voxels of the adaptive 1-D grid (Jevans 1990, §4 and §6.5): their planes, their shared states, and that they come
// into being where rays go.
#include "accel/parts/grid_1d_voxels.h"

#include <gtest/gtest.h>

#include "accel/tests/nasty_scenes.h"

namespace rayshoot {
namespace {

using Voxel = SubdividedVoxel<double>;
using Voxels = Grid1dVoxels<double>;

/// Subdivide everything that the cost function wants subdivided, and call visit(voxel) for every subdivided voxel.
template <class Real, class Visit>
void visit_all(Grid1dVoxels<Real>& voxels, const typename Subvoxel<Real>::Content& content,
               const Visit& visit) {
  if (!content.subdivided()) return;
  const SubdividedVoxel<Real>& voxel = *content.voxel();
  visit(voxel);
  for (std::uint32_t k = 0; k < voxel.granularity; ++k) {
    auto subvoxel = voxel.subvoxels()[k].read();
    if (subvoxel.undecided()) subvoxel = voxels.decide(voxel, k);
    visit_all(voxels, subvoxel, visit);
  }
}

Scene small_triangles(int count) {
  SceneBuilder builder;
  nasty::Random random(11);
  for (int i = 0; i < count; ++i) {
    const Vec3d p = nasty::uniform_point(random, -3, 5);
    builder.triangle(p, p + nasty::uniform_point(random, -0.1, 0.1),
                     p + nasty::uniform_point(random, -0.1, 0.1));
  }
  return std::move(builder).finish();
}

template <class Real>
void check_planes() {
  const Box<Real> box{{Real(-1.7), Real(3e-3), Real(100)}, {Real(12.3), Real(3.1e-3), Real(1e5)}};
  for (int axis = 0; axis < 3; ++axis)
    for (const std::uint64_t coarse : {1, 2, 3, 5, 7, 20, 49, 400, 6859})
      for (const std::uint64_t finer : {1, 2, 3, 7, 11, 19, 20}) {
        EXPECT_EQ(subdivision_plane(box, axis, 0, coarse), box.lo[axis]);
        EXPECT_EQ(subdivision_plane(box, axis, coarse, coarse), box.hi[axis]);
        for (std::uint64_t k = 0; k < std::min<std::uint64_t>(coarse, 50); ++k) {
          EXPECT_EQ(subdivision_plane(box, axis, k, coarse),
                    subdivision_plane(box, axis, k * finer, coarse * finer));
          EXPECT_LE(subdivision_plane(box, axis, k, coarse), subdivision_plane(box, axis, k + 1, coarse));
        }
      }
}

TEST(Grid1dPlanes, AreTheSameAtEveryGranularityToTheLastBit) {
  check_planes<float>();
  check_planes<double>();
}

template <class Real>
void check_borders() {
  const Geometry<Real> geometry(small_triangles(2000));
  Grid1dVoxels<Real> voxels(geometry, {}, {});
  int nested = 0;
  visit_all(voxels, voxels.root(), [&](const SubdividedVoxel<Real>& voxel) {
    const SubdividedVoxel<Real>* above = voxel.above[voxel.axis];
    EXPECT_EQ(voxel.planes()[0], voxel.context->box.lo[voxel.axis]);
    EXPECT_EQ(voxel.planes()[voxel.granularity], voxel.context->box.hi[voxel.axis]);
    if (!above) return;
    ++nested;
    const std::uint64_t index = voxel.context->numbers[voxel.axis] - above->first;
    ASSERT_LT(index, above->granularity);
    EXPECT_EQ(voxel.planes()[0], above->planes()[index]);
    EXPECT_EQ(voxel.planes()[voxel.granularity], above->planes()[index + 1]);
  });
  EXPECT_GT(nested, 100);
}

TEST(Grid1dVoxels, BordersArePlanesOfTheVoxelAbove) {
  check_borders<float>();
  check_borders<double>();
}

TEST(Grid1dVoxels, AxesAlternateWithDepthAndThoseAboveAreKnown) {
  const Geometry<double> geometry(small_triangles(2000));
  Voxels voxels(geometry, {}, {});
  visit_all(voxels, voxels.root(), [&](const Voxel& voxel) {
    const Voxel* parent = voxel.context->parent;
    EXPECT_EQ(voxel.axis, parent ? (parent->axis + 1) % 3 : 0);
    for (int axis = 0; axis < 3; ++axis) {
      const Voxel* above = parent;
      while (above && above->axis != axis) above = above->context->parent;
      EXPECT_EQ(voxel.above[axis], above);
    }
  });
}

TEST(Grid1dVoxels, AnotherAxisIsTakenWhereOneDoesNotPayIfAsked) {
  // Rods along x.
  SceneBuilder builder;
  nasty::Random random(2);
  for (int i = 0; i < 200; ++i) {
    const Vec3d p{0, nasty::uniform(random, 0, 1), nasty::uniform(random, 0, 1)};
    builder.triangle(p, p + Vec3d{1, 0, 0}, p + Vec3d{0.5, 0.01, 0.01});
  }
  const Geometry<double> geometry(std::move(builder).finish());
  EXPECT_FALSE(Voxels(geometry, {}, {.axes = AxisRule::alternate}).root().subdivided());
  const Voxels paying(geometry, {}, {.axes = AxisRule::paying});
  ASSERT_TRUE(paying.root().subdivided());
  EXPECT_EQ(paying.root().voxel()->axis, 1);
}

TEST(Grid1dVoxels, GranularityIsTheCheapestOfTheCostFunction) {
  const Geometry<double> geometry(small_triangles(300));
  const Box<double>& box = geometry.bounds();
  const Vec3d size = box.extent();
  double sizes = 0;
  for (std::uint32_t object = 0; object < geometry.size(); ++object)
    sizes += geometry.bounds(object).extent().x;
  const double area = size.x * size.y + size.y * size.z + size.z * size.x;
  const std::vector<Ray<double>> rays(40, {.origin = {-5, 1, 1}, .direction = {1, 0.1, 0.1}});
  for (const double subcost : {0.0, 1e3, 1e6}) {
    Grid1dRules rules;
    rules.timings.subcost = subcost;
    const int cheapest = cheapest_granularity(rules.timings,
                                              {.num_objects = 300,
                                               .mean_object_size = sizes / 300,
                                               .voxel_size = size.x,
                                               .area_beside = 1 - size.y * size.z / area,
                                               .area_across = size.y * size.z / area,
                                               .estimated_num_rays = 40 * 3},
                                              20);
    const Voxels voxels(geometry, {rays, 3}, rules);
    EXPECT_EQ(voxels.root().subdivided(), cheapest > 0);
    if (cheapest > 0) {
      EXPECT_EQ(voxels.root().voxel()->granularity, static_cast<std::uint32_t>(cheapest));
    }
  }
}

TEST(Grid1dVoxels, ShareStatesOfTheSameAxisAndAbsoluteGranularity) {
  const Geometry<double> geometry(small_triangles(5000));
  Voxels voxels(geometry, {}, {});
  std::map<std::pair<int, std::uint64_t>, std::uint32_t> states;
  double subdivided = 0;
  visit_all(voxels, voxels.root(), [&](const Voxel& voxel) {
    std::uint64_t absolute = voxel.granularity;
    for (const Voxel* above = voxel.above[voxel.axis]; above; above = above->above[voxel.axis])
      absolute *= above->granularity;
    EXPECT_EQ(absolute, voxel.context->absolute_granularity);
    EXPECT_EQ(states.try_emplace({voxel.axis, absolute}, voxel.state).first->second, voxel.state);
    ++subdivided;
  });
  std::set<std::uint32_t> different;
  for (const auto& [key, state] : states) different.insert(state);
  EXPECT_EQ(different.size(), states.size());

  const StructureStats stats = voxels.structure();
  EXPECT_EQ(stats.figures.at("voxels_subdivided"), subdivided);
  EXPECT_EQ(stats.figures.at("candidates_untouched"), 0);
  const auto created = static_cast<double>(states.size());
  EXPECT_EQ(stats.figures.at("traversal_states_created"), created);
  EXPECT_DOUBLE_EQ(stats.figures.at("traversal_states_saved_percent"), 100 * (1 - created / subdivided));
  EXPECT_GT(stats.figures.at("traversal_states_saved_percent"), 95);
}

TEST(Grid1dVoxels, RaysAreEstimatedFromTheSampleOrFromTheParent) {
  const Geometry<double> geometry(small_triangles(3000));
  nasty::Random random(4);
  std::vector<Ray<double>> rays(30);
  for (Ray<double>& ray : rays)
    ray = {.origin = {-8, nasty::uniform(random, -3, -1), nasty::uniform(random, -3, -1)},
           .direction = {1, 0, 0}};
  Voxels voxels(geometry, {rays, 50}, {});
  ASSERT_TRUE(voxels.root().subdivided());
  EXPECT_EQ(voxels.root().voxel()->context->estimated_num_rays, 30 * 50);
  int met = 0, estimated = 0;
  visit_all(voxels, voxels.root(), [&](const Voxel& voxel) {
    const Voxel* parent = voxel.context->parent;
    if (!parent) return;
    const Box<double>& box = voxel.context->box;
    // The sample ends at the hits it finds: it may be less than what passes, but not other than whole rays.
    int passing = 0;
    for (const Ray<double>& ray : rays) {
      const Interval<double> inside = Crossings<double>(ray).inside(box);
      passing += inside.enter <= inside.exit;
    }
    const double rays_here = voxel.context->estimated_num_rays;
    const double by_surface =
        parent->context->estimated_num_rays * box.surface_area() / parent->context->box.surface_area();
    if (passing == 0 || rays_here != std::floor(rays_here)) {
      ++estimated;
      EXPECT_DOUBLE_EQ(rays_here, by_surface);
    } else {
      ++met;
      EXPECT_LE(rays_here, 50 * passing);
      EXPECT_GE(rays_here, 50);
    }
  });
  EXPECT_GT(met, 10);
  EXPECT_GT(estimated, 10);
}

TEST(Grid1dVoxels, PlanesThatCannotBeToldApartEndSubdivision) {
  SceneBuilder builder;
  for (int i = 0; i < 300; ++i) builder.sphere({1, 1, 1}, 1e-9);
  builder.sphere({0, 0, 0}, 1e-3);
  const Geometry<float> geometry(std::move(builder).finish());
  Grid1dRules rules;
  rules.timings = {.intcost = 1e9, .repcost = 0, .travcost = 0, .vertcost = 0, .subcost = 0};
  Grid1dVoxels<float> voxels(geometry, {}, rules);
  visit_all(voxels, voxels.root(), [](const SubdividedVoxel<float>& voxel) {
    for (std::uint32_t k = 0; k < voxel.granularity; ++k) EXPECT_LT(voxel.planes()[k], voxel.planes()[k + 1]);
  });
  EXPECT_LE(voxels.structure().max_depth, 60u);
}

TEST(Grid1dVoxels, StorageIsLimited) {
  // Sheets through one another in every direction: no subdivision keeps them apart.
  SceneBuilder builder;
  nasty::Random random(3);
  for (int i = 0; i < 3000; ++i)
    builder.triangle(nasty::uniform_point(random, -1, 1), nasty::uniform_point(random, -1, 1),
                     nasty::uniform_point(random, -1, 1));
  const Geometry<float> geometry(std::move(builder).finish());
  Grid1dRules rules;
  rules.timings = {.intcost = 1e9, .repcost = 0, .travcost = 0, .vertcost = 0, .subcost = 0};
  Grid1dVoxels<float> voxels(geometry, {}, rules);
  visit_all(voxels, voxels.root(), [](const SubdividedVoxel<float>&) {});
  EXPECT_LE(voxels.structure().bytes, (3000u * 160 + (1u << 18)) * 4 * 2);
}

}  // namespace
}  // namespace rayshoot
