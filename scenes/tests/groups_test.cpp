// The modeller's hierarchy: what every generator's groups owe, and that they follow its recursion.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <map>

#include "scenes/core/geometry.h"
#include "scenes/core/registry.h"
#include "scenes/io/load_scene.h"

namespace rayshoot {
namespace {

using Groups = std::span<const Group>;

/// Numbers of groups by their depth.
std::map<int, int> groups_by_depth(Groups groups) {
  std::map<int, int> counts;
  for (std::size_t i = 0; i < groups.size(); ++i) {
    int depth = 0;
    for (std::size_t about = 0; about < i; ++about) depth += groups[about].end > i;
    ++counts[depth];
  }
  return counts;
}

/// Every group lies inside the one about it, and behind the one before it.
void expect_nested(Groups groups, std::uint32_t objects) {
  ASSERT_FALSE(groups.empty());
  EXPECT_EQ(groups[0], (Group{0, objects, static_cast<std::uint32_t>(groups.size())})) << "the whole scene";
  for (std::uint32_t i = 0; i < groups.size(); ++i) {
    ASSERT_GT(groups[i].end, i);
    ASSERT_LE(groups[i].first, groups[i].last);
    std::uint32_t first = groups[i].first;
    for (std::uint32_t nested = i + 1; nested < groups[i].end; nested = groups[nested].end) {
      ASSERT_GE(groups[nested].first, first) << "an object is in two groups";
      ASSERT_LE(groups[nested].last, groups[i].last) << "an object of a group is not in the group about it";
      ASSERT_LE(groups[nested].end, groups[i].end);
      first = groups[nested].last;
    }
  }
}

TEST(Groups, OfEveryGeneratorNestAndHoldEveryObjectOnce) {
  for (const SceneGenerator* generator : scene_generators())
    for (const char* form : {"curves", "patches"}) {
      const std::string spec = fmt::format("{}:{}/{}", generator->id, std::max(2, generator->min_size), form);
      SCOPED_TRACE(spec);
      const Scene scene = load_scene(spec).scene;
      // Parts are what is kept together where something is placed.
      if (!scene.placements.empty()) continue;
      expect_nested(scene.groups, static_cast<std::uint32_t>(scene.size()));
      EXPECT_GT(scene.groups.size(), 1u);
    }
}

TEST(Groups, FollowTheRecursionOfTheGenerator) {
  using Counts = std::map<int, int>;
  const auto counts = [](const char* spec) { return groups_by_depth(load_scene(spec).scene.groups); };
  EXPECT_EQ(counts("balls:2"), (Counts{{0, 1}, {1, 1}, {2, 9}, {3, 81}}))
      << "a sphere with its nine children";
  EXPECT_EQ(counts("tree:3"), (Counts{{0, 1}, {1, 1}, {2, 2}, {3, 4}, {4, 8}})) << "a branch with two more";
  EXPECT_EQ(counts("tetra:3"), (Counts{{0, 1}, {1, 1}, {2, 4}, {3, 16}})) << "four pyramids in each";
  EXPECT_EQ(counts("mount:2"), (Counts{{0, 1}, {1, 2}, {2, 4}, {3, 16}}))
      << "the balls; quadrants of quadrants";
  EXPECT_EQ(counts("gears:2"), (Counts{{0, 1}, {1, 2}, {2, 4}, {3, 8}, {4, 288}}))
      << "layer, row, gear, tooth";
  EXPECT_EQ(counts("lattice:1"), (Counts{{0, 1}, {1, 2}, {2, 4}, {3, 8}})) << "layer, row, node";
  EXPECT_EQ(counts("jacks:2"), (Counts{{0, 1}, {1, 1}, {2, 8}})) << "a jack with eight smaller";
  EXPECT_EQ(counts("rings:2"), (Counts{{0, 1}, {1, 2}, {2, 3}, {3, 5}, {4, 30}}))
      << "layer, row, cluster, ring";
  EXPECT_EQ(counts("shells:1"), (Counts{{0, 1}, {1, 10}})) << "nine turns and the last sphere";
  EXPECT_EQ(counts("sombrero:1"), (Counts{{0, 1}, {1, 31}})) << "strips";
  EXPECT_EQ(counts("teapot:2"), (Counts{{0, 1}, {1, 34}})) << "squares of two colours, 32 patches";
}

TEST(Groups, ATessellatedSphereIsAGroup) {
  const Scene scene = load_scene("balls:1/patches").scene;
  EXPECT_EQ(groups_by_depth(scene.groups), (std::map<int, int>{{0, 1}, {1, 1}, {2, 10}, {3, 9}}));
  EXPECT_EQ(scene.groups[2].size(), 108u) << "the triangles of the first sphere";
}

TEST(Groups, SurviveTessellationOfAScene) {
  const Scene curves = load_scene("balls:1").scene;
  EXPECT_EQ(tessellated(curves, 3).groups, load_scene("balls:1/patches").scene.groups);
}

TEST(Groups, AreNoPartOfAScenesContent) {
  const Scene scene = load_scene("balls:1").scene;
  Scene ungrouped = scene;
  ungrouped.groups.clear();
  EXPECT_TRUE(same_content(scene, ungrouped));
  EXPECT_EQ(scene_hash(scene), scene_hash(ungrouped));
}

TEST(Groups, WithoutObjectsAreNone) {
  SceneBuilder builder;
  {
    const auto outer = builder.group();
    { const auto empty = builder.group(); }
    builder.sphere({0, 0, 0}, 1);
  }
  builder.sphere({2, 0, 0}, 1);
  EXPECT_EQ(std::move(builder).finish().groups, (std::vector<Group>{{0, 2, 2}, {0, 1, 2}}));
}

TEST(Groups, OfAGeometryLeaveOutWhatIsSetAside) {
  SceneBuilder builder;
  builder.sphere({0, 0, 0}, -1);
  {
    const auto group = builder.group();
    builder.sphere({0, 0, 0}, 1), builder.sphere({0, 0, 0}, 0), builder.sphere({0, 0, 0}, 2);
  }
  {
    const auto group = builder.group();
    builder.sphere({0, 0, 0}, -2);
  }
  builder.sphere({0, 0, 0}, 3);
  const Scene scene = std::move(builder).finish();
  const Geometry<float> geometry(scene);
  const std::vector<Group> expected{{0, 3, 3}, {0, 2, 2}, {2, 2, 3}};
  EXPECT_TRUE(
      std::equal(expected.begin(), expected.end(), geometry.groups().begin(), geometry.groups().end()));
  const std::uint32_t reversed[] = {2, 1, 0};
  EXPECT_TRUE(geometry.arranged(reversed).groups().empty());
}

TEST(Groups, AFileHasNone) {
  SceneBuilder builder;
  builder.sphere({0, 0, 0}, 1);
  EXPECT_TRUE(std::move(builder).finish().groups.empty());
}

}  // namespace
}  // namespace rayshoot
