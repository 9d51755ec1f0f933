// What compositions are, beyond giving the answers of exhaustive search (conformance_test.cpp): the candidates that the
// equations of Revelles and Ureña say.
#include <gtest/gtest.h>

#include "accel/tests/built_engine.h"
#include "accel/tests/conformance.h"
#include "accel/tests/expressions.h"
#include "scenes/io/load_scene.h"

namespace rayshoot {
namespace {

using Objects = std::vector<std::uint32_t>;

class Compositions : public ::testing::Test {
 protected:
  std::unique_ptr<Engine<double>> build(const std::string& text) const {
    const Expression expression = parsed(text);
    const Arguments none;
    return compose(expression).build<double>({geometry_, none});
  }

  std::vector<Objects> strict(const Engine<double>& engine) const {
    const auto scratch = engine.scratch();
    std::vector<Objects> all;
    for (const Ray<double>& ray : rays_) all.push_back(engine.candidates(Query::strict, ray, *scratch));
    return all;
  }
  std::vector<Objects> strict(const std::string& text) const { return strict(*build(text)); }

  /// Whether two optimizers have the same candidates of all rays; the first ray with others is told.
  void expect_same(const std::vector<Objects>& one, const std::vector<Objects>& other,
                   const std::string& what) const {
    for (std::size_t i = 0; i < rays_.size(); ++i)
      ASSERT_EQ(one[i], other[i]) << what << ": " << conformance::describe(rays_[i]);
  }

  Work work(const std::string& text, Query query) const { return counted(*build(text), query, rays_).work; }

  /// Rays without end have no hits, and what candidates they have is up to the technique.
  static std::vector<Ray<double>> finite(std::vector<Ray<double>> rays) {
    std::erase_if(rays, [](const Ray<double>& ray) {
      return !std::isfinite(max_abs(ray.origin) + max_abs(ray.direction));
    });
    return rays;
  }

  Geometry<double> geometry_{soup_scene(600)};
  std::vector<Ray<double>> rays_ = finite(nasty::rays(geometry_, 1, 400));
};

/// §5.3: an octree is a grid of 2×2×2 voxels composed with itself.
TEST_F(Compositions, RecursiveGridOfEightVoxelsHasTheCandidatesOfTheOctree) {
  for (const auto& [until, depth] : {std::pair{2, 3}, {8, 4}, {20, 5}}) {
    const std::string recursive =
        fmt::format("recursive(uniform_grid(resolution=2x2x2),until={},max_depth={})", until, depth);
    const Given octree{{"max_depth", std::to_string(depth)},
                       {"max_objects", std::to_string(until)},
                       {"assignment", "box"},
                       {"separating", "off"}};
    expect_same(strict(recursive), strict(*rayshoot::build("octree_revelles", geometry_, octree)), recursive);
  }
}

/// §5.3: a binary tree is one of two voxels along each axis in turn.
TEST_F(Compositions, RecursiveGridsOfTwoVoxelsHaveTheCandidatesOfTheBinaryTree) {
  const std::string two_along_each =
      "sequential(sequential(uniform_grid(resolution=2x1x1),uniform_grid(resolution=1x2x1),until=30,box="
      "voxel),"
      "uniform_grid(resolution=1x1x2),until=30,box=voxel)";
  const Given tree{{"max_depth", "6"}, {"max_objects", "30"}};
  expect_same(strict("recursive(" + two_along_each + ",until=30,max_depth=2)"),
              strict(*rayshoot::build("bsp_kaplan", geometry_, tree)), two_along_each);
}

TEST_F(Compositions, BelowTheThresholdAVoxelKeepsItsList) {
  const auto listed = build("sequential(uniform_grid,bvh_sah,until=1000000)");
  EXPECT_EQ(listed->structure().figures.at("sub_scenes"), 0);
  EXPECT_EQ(strict(*listed), strict(*rayshoot::build("uniform_grid", geometry_)));
  const auto divided = build("sequential(uniform_grid,bvh_sah,until=3)");
  EXPECT_GT(divided->structure().figures.at("sub_scenes"), 0);
  EXPECT_LT(divided->structure().figures.at("divided_voxels"), divided->structure().figures.at("voxels"));
}

TEST(EqualSubScenes, AreBuiltOnce) {
  // Twenty long needles side by side: all voxels of a row list the same ones.
  SceneBuilder builder;
  for (int i = 0; i < 20; ++i) {
    const double y = 0.01 * i;
    builder.triangle({0, y, 0}, {100, y, 0}, {100, y + 0.001, 1});
  }
  const Geometry<double> geometry(std::move(builder).finish());
  const Arguments none;
  const auto figures = [&](const char* text) {
    return compose(parsed(text)).build<double>({geometry, none})->structure().figures;
  };
  const auto shared = figures("sequential(uniform_grid(resolution=50x1x1),bvh_sah,box=objects)");
  EXPECT_EQ(shared.at("divided_voxels"), 50);
  EXPECT_EQ(shared.at("sub_scenes"), 1);
  EXPECT_EQ(figures("uniform_grid(resolution=50x1x1)|bvh_sah").at("sub_scenes"), 50);
}

TEST_F(Compositions, WorkIsCountedLevelByLevel) {
  const Work composed = work("uniform_grid(resolution=4x4x4)|bvh_sah", Query::strict);
  const Work first =
      counted(*rayshoot::build("uniform_grid", geometry_, {{"resolution", "4x4x4"}}), Query::strict, rays_)
          .work;
  EXPECT_EQ(composed.events[0], first.steps);
  EXPECT_EQ(composed.events[1], first.distinct_objects);
  EXPECT_EQ(composed.events[3], composed.distinct_objects);
  EXPECT_LT(composed.events[3], composed.events[1]);
  EXPECT_EQ(composed.steps, composed.events[0] + composed.events[2]);
  EXPECT_GT(composed.volume_tests, 0u);
}

/// §5.2: the parallel composition never has more candidates than either of its parts, and here it has fewer.
TEST_F(Compositions, ParallelCompositionHasTheCandidatesOfBoth) {
  for (const auto& [a, b] : {std::pair{"uniform_grid", "octree_revelles"}, {"bvh_sah", "bsp_jansen"}}) {
    const auto of_a = strict(*rayshoot::build(a, geometry_)), of_b = strict(*rayshoot::build(b, geometry_));
    const auto of_both = strict(fmt::format("{}||{}", a, b));
    for (std::size_t i = 0; i < rays_.size(); ++i) {
      Objects both;
      std::set_intersection(of_a[i].begin(), of_a[i].end(), of_b[i].begin(), of_b[i].end(),
                            std::back_inserter(both));
      ASSERT_EQ(of_both[i], both) << conformance::describe(rays_[i]);
    }
    EXPECT_NE(of_both, of_a);
    EXPECT_NE(of_both, of_b);
  }
}

/// The sets are not made whole: the search ends with the stretch in which the hit is.
TEST_F(Compositions, ParallelCompositionStopsAtTheHit) {
  const Work closest = work("uniform_grid||octree_revelles", Query::closest),
             strict = work("uniform_grid||octree_revelles", Query::strict);
  for (const std::size_t level : {0, 1})
    EXPECT_LT(closest.events[2 * level + 1] * 10, strict.events[2 * level + 1] * 9);
}

/// What `scherson_caspary` is by its paper.
TEST_F(Compositions, SchersonAndCasparyPutHierarchiesIntoOctreeLeaves) {
  const auto engine = rayshoot::build("scherson_caspary", geometry_);
  expect_same(
      strict(*engine),
      strict("octree_revelles(max_depth=3,max_objects=64,assignment=box)|bvh_kay_kajiya(plane_sets=3)"),
      "scherson_caspary");
  EXPECT_GT(engine->structure().figures.at("sub_scenes"), 8);
  // Fewer candidates than its octree, for its hierarchies hold objects tightly.
  const Work work = counted(*engine, Query::strict, rays_).work;
  EXPECT_LT(work.distinct_objects * 2, work.events[1]);
}

}  // namespace
}  // namespace rayshoot
