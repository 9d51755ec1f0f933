// What makes bvh_rubin_whitted and bvh_weghorst those techniques.
#include <gtest/gtest.h>

#include "accel/parts/object_hierarchy.h"
#include "accel/parts/volume_kinds.h"
#include "accel/tests/built_engine.h"
#include "accel/tests/conformance.h"
#include "scenes/core/affine.h"
#include "scenes/io/load_scene.h"

namespace rayshoot {
namespace {

constexpr const char* kIds[] = {"bvh_rubin_whitted", "bvh_weghorst"};

double figure(const Engine<double>& engine, const char* name) { return engine.structure().figures.at(name); }

/// Slabs of 4 x 2 x 1 side by side, all turned alike.
Scene turned_slabs() {
  SceneBuilder builder;
  const Affine turn = rotation(normalized(Vec3d{1, 2, 3}), 0.8);
  for (int i = 0; i < 3; ++i)
    for (const double z : {-0.5, 0.5})
      builder.polygon(std::array{turn({-6, 2.0 * i, z}), turn({6, 2.0 * i, z}), turn({6, 2.0 * i + 2, z}),
                                 turn({-6, 2.0 * i + 2, z})});
  return std::move(builder).finish();
}

TEST(BvhRubinWhitted, TransformsTheRayOncePerTurnedBoxTested) {
  const Geometry<double> geometry(turned_slabs());
  const auto rays = nasty::rays(geometry, 1, 50);
  const auto turned = build("bvh_rubin_whitted", geometry, {{"max_objects", "1"}});
  EXPECT_EQ(figure(*turned, "axis_box_volumes"), 0) << "every box is smaller turned";
  const Work work = counted(*turned, Query::closest, rays).work;
  EXPECT_GT(work.volume_tests, rays.size());
  EXPECT_EQ(work.events[0], work.volume_tests);
  const auto straight = build("bvh_rubin_whitted", geometry, {{"orientation", "axis_aligned"}});
  EXPECT_EQ(figure(*straight, "oriented_box_volumes"), 0);
  EXPECT_EQ(counted(*straight, Query::closest, rays).work.events[0], 0u);
}

TEST(BvhRubinWhitted, TurnsABoxOnlyWhereItIsSmallerSo) {
  SceneBuilder builder;
  for (int i = 0; i < 6; ++i)
    builder.polygon(std::array{Vec3d{-6, -2, i * 0.1}, Vec3d{6, -2, i * 0.1}, Vec3d{6, 2, i * 0.1},
                               Vec3d{-6, 2, i * 0.1}});
  const Geometry<double> geometry(std::move(builder).finish());
  EXPECT_EQ(figure(*build("bvh_rubin_whitted", geometry), "oriented_box_volumes"), 0);
}

TEST(BvhRubinWhitted, TurnedBoxesTestFewerObjects) {
  const Geometry<double> geometry(load_scene("tree:6").scene);
  const auto rays = nasty::rays(geometry, 1, 200);
  const auto tests = [&](const char* orientation) {
    return counted(*build("bvh_rubin_whitted", geometry, {{"orientation", orientation}}), Query::closest,
                   rays)
        .work.object_tests;
  };
  EXPECT_LT(tests("principal"), tests("axis_aligned"));
}

TEST(ObjectHierarchy, TheModellersHasANodeForEveryGroup) {
  for (const char* spec :
       {"balls:2", "tetra:3", "tree:4", "gears:2", "shells:1", "mount:3", "balls:1/patches", "drum:1"}) {
    const Scene scene = load_scene(spec).scene;
    const Geometry<double> geometry(scene);
    for (const char* id : kIds)
      EXPECT_EQ(figure(*build(id, geometry), "modelled_nodes"), scene.groups.size()) << spec;
  }
}

TEST(ObjectHierarchy, TheModellersHasNoOtherNodesWhereGroupsAreSmall) {
  for (const char* spec : {"balls:2", "tetra:3", "tree:4", "mount:3"}) {
    const Scene scene = load_scene(spec).scene;
    const Geometry<double> geometry(scene);
    const ObjectHierarchy hierarchy = object_hierarchy(geometry, {});
    ASSERT_EQ(hierarchy.nodes.size(), scene.groups.size()) << spec;
    for (std::size_t i = 0; i < hierarchy.nodes.size(); ++i) {
      EXPECT_EQ(hierarchy.nodes[i].end, scene.groups[i].end);
      EXPECT_EQ(hierarchy.nodes[i].last - hierarchy.nodes[i].first, scene.groups[i].size());
    }
  }
}

/// Every object stands in exactly one node as its own, and nodes keep their limits.
void expect_whole(const ObjectHierarchy& hierarchy, const Geometry<double>& geometry,
                  std::uint32_t max_objects) {
  std::vector<std::uint32_t> order = hierarchy.order;
  std::sort(order.begin(), order.end());
  ASSERT_EQ(order.size(), geometry.size());
  for (std::uint32_t i = 0; i < order.size(); ++i) ASSERT_EQ(order[i], i);
  std::uint32_t own = 0;
  for (std::uint32_t i = 0; i < hierarchy.nodes.size(); ++i) {
    const ObjectHierarchy::Node& node = hierarchy.nodes[i];
    ASSERT_LE(node.own_last - node.first, max_objects);
    own += node.own_last - node.first;
    std::uint32_t next = node.own_last;
    for (std::uint32_t below = i + 1; below < node.end; below = hierarchy.nodes[below].end) {
      ASSERT_EQ(hierarchy.nodes[below].first, next);
      next = hierarchy.nodes[below].last;
    }
    ASSERT_EQ(next, node.last);
  }
  EXPECT_EQ(own, geometry.size());
}

TEST(ObjectHierarchy, HoldsEveryObjectOnceWithinItsLimits) {
  std::vector<Scene> scenes{soup_scene(500), load_scene("balls:2").scene, load_scene("gears:1").scene,
                            load_scene("sombrero:1").scene};
  SceneBuilder pile;
  for (int i = 0; i < 20'000; ++i) pile.triangle({0, 0, 0}, {1, 0, 0}, {0, 1, 0});
  for (int i = 0; i < 900; ++i) pile.sphere({std::ldexp(1, -i), 0, 0}, std::ldexp(1, -i - 2));
  scenes.push_back(std::move(pile).finish());
  for (const Scene& scene : scenes) {
    const Geometry<double> geometry(scene);
    for (const HierarchySource source : {HierarchySource::modeller, HierarchySource::automatic})
      for (const int resolution : {3, 8, 64})
        for (const std::uint32_t max_objects : {1u, 4u})
          expect_whole(object_hierarchy(geometry, {source, resolution, max_objects}), geometry, max_objects);
  }
}

TEST(ObjectHierarchy, TheHistogramPutsTwoDistantClustersIntoTwoNodes) {
  SceneBuilder builder;
  for (int i = 0; i < 64; ++i) builder.sphere({(i % 2) * 1000.0, i * 0.1, i % 7 * 0.1}, 0.01);
  const Geometry<double> geometry(std::move(builder).finish());
  const ObjectHierarchy hierarchy = object_hierarchy(geometry, {.source = HierarchySource::automatic});
  std::vector<std::uint32_t> below_root;
  for (std::uint32_t node = 1; node < hierarchy.nodes.size(); node = hierarchy.nodes[node].end) {
    below_root.push_back(node);
    for (std::uint32_t i = hierarchy.nodes[node].first; i < hierarchy.nodes[node].last; ++i)
      EXPECT_EQ(hierarchy.order[i] % 2, hierarchy.order[hierarchy.nodes[node].first] % 2);
  }
  EXPECT_EQ(below_root.size(), 2u);
}

TEST(ObjectHierarchy, TheDensestPeaksBecomeClustersFirst) {
  // Nine places in a row, of which a node takes eight; the place of one object joins its denser neighbour. So many objects
  // that the histogram may have a cell for every place.
  SceneBuilder builder;
  for (int place = 0; place < 9; ++place)
    for (int i = 0; i < (place == 4 ? 1 : 600); ++i) builder.sphere({place * 10.0, 0, 0}, 0.1);
  const Geometry<double> geometry(std::move(builder).finish());
  const ObjectHierarchy hierarchy =
      object_hierarchy(geometry, {.source = HierarchySource::automatic, .resolution = 64});
  std::vector<std::uint32_t> sizes;
  for (std::uint32_t node = 1; node < hierarchy.nodes.size(); node = hierarchy.nodes[node].end)
    sizes.push_back(hierarchy.nodes[node].last - hierarchy.nodes[node].first);
  std::sort(sizes.begin(), sizes.end());
  EXPECT_EQ(sizes, (std::vector<std::uint32_t>{600, 600, 600, 600, 600, 600, 600, 601}));
}

TEST(ObjectHierarchy, WithoutGroupsTheModellersIsTheAutomaticOne) {
  const Scene scene = soup_scene(300);
  const Geometry<double> geometry(scene);
  const auto order = [&](HierarchySource source) {
    return object_hierarchy(geometry, {.source = source}).order;
  };
  EXPECT_EQ(order(HierarchySource::modeller), order(HierarchySource::automatic));
  for (const char* id : kIds) EXPECT_EQ(figure(*build(id, geometry), "modelled_nodes"), 0);
}

/// How many volumes of each kind bvh_weghorst chose.
std::array<double, 4> chosen(const Scene& scene) {
  const Geometry<double> geometry(scene);
  const auto engine = build("bvh_weghorst", geometry, {{"max_objects", "1"}});
  std::array<double, 4> counts{};
  for (std::size_t kind = 0; kind < 4; ++kind)
    counts[kind] = figure(*engine, (kVolumeKindNames[kind] + std::string("_volumes")).c_str());
  return counts;
}

TEST(BvhWeghorst, TakesTheVolumeThatSuitsTheObjects) {
  SceneBuilder balls, rods, slabs;
  for (int i = 0; i < 8; ++i) {
    const Vec3d at{i % 2 * 20.0, i / 2 % 2 * 20.0, i / 4 * 20.0};
    balls.sphere(at, 1);
    rods.cone(at, 0.02, at + Vec3d{3, 2.5, 2}, 0.02);
    for (const double side : {-2.0, 2.0})
      nasty::square(slabs, at + Vec3d{0, 0, 5 * side}, {4, 0, 0}, {0, 4, 0});
  }
  EXPECT_GE(chosen(std::move(balls).finish())[0], 8);
  const auto of_rods = chosen(std::move(rods).finish());
  EXPECT_GE(of_rods[2] + of_rods[3], 8);
  EXPECT_GE(chosen(std::move(slabs).finish())[1], 16);
}

TEST(BvhWeghorst, ChoosesTheLeastProjectedAreaTimesCost) {
  const Geometry<double> geometry(load_scene("tree:4").scene);
  const ObjectHierarchy hierarchy = object_hierarchy(geometry, {});
  std::array<double, 4> expected{};
  for (const ObjectHierarchy::Node& node : hierarchy.nodes) {
    const auto volumes = bounding_volumes<double>(
        geometry, std::span(hierarchy.order).subspan(node.first, node.last - node.first));
    std::size_t best = 0;
    for (std::size_t kind = 1; kind < 4; ++kind)
      if (volumes[kind].surface_area() * kVolumeTestCost[kind] <
          volumes[best].surface_area() * kVolumeTestCost[best])
        best = kind;
    ++expected[best];
  }
  const auto engine = build("bvh_weghorst", geometry);
  for (std::size_t kind = 0; kind < 4; ++kind)
    EXPECT_EQ(figure(*engine, (kVolumeKindNames[kind] + std::string("_volumes")).c_str()), expected[kind]);
}

TEST(BvhWeghorst, CountsTheTestsOfEachKind) {
  const Geometry<double> geometry(load_scene("tree:4").scene);
  const Work work =
      counted(*build("bvh_weghorst", geometry), Query::closest, nasty::rays(geometry, 1, 50)).work;
  EXPECT_EQ(work.events[0] + work.events[1] + work.events[2] + work.events[3], work.volume_tests);
}

TEST(VolumeTree, AnswersAsExhaustiveSearchOnAModelledScene) {
  for (const char* spec : {"balls:2", "gears:1", "tree:4/patches", "drum:1"}) {
    SCOPED_TRACE(spec);
    const Geometry<double> geometry(load_scene(spec).scene);
    const auto rays = nasty::rays(geometry, 1, spec[0] == 'd' ? 4 : 20);
    const auto truths = conformance::truths<double>(geometry, rays);
    for (const char* id : kIds)
      for (const Given& given : {Given{}, Given{{"max_objects", "1"}, {"resolution", "3"}}})
        conformance::check_engine<double>(*build(id, geometry, given), rays, truths);
  }
}

}  // namespace
}  // namespace rayshoot
