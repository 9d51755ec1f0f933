#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <map>

#include "scenes/geometry/polygon.h"
#include "scenes/io/load_scene.h"

namespace rayshoot {
namespace {

/// The mean of each object's vertices.
std::vector<Vec3d> centres(const Scene& scene) {
  std::vector<Vec3d> result;
  for (std::uint32_t object = 0; object < scene.size(); ++object) {
    Vec3d sum{};
    const std::uint32_t count = scene.vertex_count(object);
    for (std::uint32_t corner = 0; corner < count; ++corner) sum += scene.vertex(object, corner);
    result.push_back(sum * (1.0 / count));
  }
  return result;
}

/// The smallest share of the scene's box, in cells of a 64th of each extent, that holds `share` of the objects.
double volume_holding(const Scene& scene, double share) {
  constexpr int kCells = 64;
  const Box<double> box = scene.bounds();
  std::map<std::array<int, 3>, std::size_t> cells;
  for (const Vec3d& centre : centres(scene)) {
    std::array<int, 3> cell;
    for (int axis = 0; axis < 3; ++axis)
      cell[static_cast<std::size_t>(axis)] =
          std::min(kCells - 1, static_cast<int>((centre[axis] - box.lo[axis]) / box.extent()[axis] * kCells));
    ++cells[cell];
  }
  std::vector<std::size_t> counts;
  counts.reserve(cells.size());
  for (const auto& [cell, count] : cells) counts.push_back(count);
  std::sort(counts.begin(), counts.end(), std::greater());
  std::size_t held = 0, used = 0;
  while (static_cast<double>(held) < share * static_cast<double>(scene.size())) held += counts[used++];
  return static_cast<double>(used) / (kCells * kCells * kCells);
}

/// The objects whose centres satisfy a condition: their share of all, and their box.
struct Part {
  double share = 0;
  Box<double> box;

  Part(const Scene& scene, const std::function<bool(const Vec3d&)>& belongs) {
    const std::vector<Vec3d> all = centres(scene);
    for (std::uint32_t object = 0; object < scene.size(); ++object) {
      if (!belongs(all[object])) continue;
      share += 1.0 / static_cast<double>(scene.size());
      for (std::uint32_t corner = 0; corner < scene.vertex_count(object); ++corner)
        box.include(scene.vertex(object, corner));
    }
  }
};

double longest(const Vec3d& extent) { return std::max({extent.x, extent.y, extent.z}); }
double shortest(const Vec3d& extent) { return std::min({extent.x, extent.y, extent.z}); }
double volume(const Box<double>& box) { return box.extent().x * box.extent().y * box.extent().z; }

/// Whether the pinhole camera sees a point, were nothing in the way.
bool in_view(const View& view, const Vec3d& point) {
  const Vec3d ahead = normalized(view.at - view.from), right = normalized(cross(ahead, view.up)),
              up = cross(right, ahead);
  const Vec3d to_point = point - view.from;
  const double reach = std::tan(view.angle / 2 * 3.14159265358979 / 180) * dot(to_point, ahead);
  return std::abs(dot(to_point, right)) <= reach && std::abs(dot(to_point, up)) <= reach;
}

TEST(Jevans, ScenesHaveHisPolygonCounts) {
  const std::map<std::string, std::size_t> counts = {
      {"pyramid", 4096}, {"lumpy", 5938}, {"drum", 59672}, {"trike", 130398}, {"car", 198001}};
  for (const auto& [id, count] : counts) {
    const Scene scene = load_scene(id).scene;
    EXPECT_EQ(scene.size(), count) << id;
    EXPECT_EQ(scene.triangles.size() + scene.polygons.size(), count) << id;
  }
}

TEST(Jevans, PolygonCountsGrowAsDocumented) {
  EXPECT_EQ(load_scene("pyramid:3").scene.size(), 64u);
  const std::map<std::string, std::pair<int, int>> formulas = {
      {"lumpy", {366, 82}}, {"drum", {3712, 280}}, {"trike", {8146, 62}}, {"car", {12368, 113}}};
  for (const auto& [id, formula] : formulas)
    for (const int size : {1, 3})
      EXPECT_EQ(load_scene(fmt::format("{}:{}", id, size)).scene.size(),
                formula.first * size * size + formula.second)
          << id;
}

TEST(Jevans, PolygonsAreFlatAndHaveAnArea) {
  for (const char* id : {"pyramid", "lumpy", "drum", "trike", "car", "stadium"}) {
    const Scene scene = load_scene(id).scene;
    const double scale = longest(scene.bounds().extent());
    for (std::uint32_t object = 0; object < scene.size(); ++object) {
      std::vector<Vec3d> vertices;
      for (std::uint32_t corner = 0; corner < scene.vertex_count(object); ++corner)
        vertices.push_back(scene.vertex(object, corner));
      const Vec3d area = make_polygon<double>(vertices, 0).normal;
      ASSERT_GT(length(area), 1e-16 * scale * scale) << id << " " << object;
      for (const Vec3d& vertex : vertices)
        ASSERT_LT(std::abs(dot(normalized(area), vertex - vertices[0])), 1e-9 * scale) << id << " " << object;
    }
  }
}

TEST(Jevans, PyramidIsEvenAndWhollyInView) {
  const Scene scene = load_scene("pyramid").scene;
  EXPECT_LT(volume_holding(scene, 0.9) / volume_holding(scene, 0.5), 3);
  for (const Triangle<double>& t : scene.triangles)
    ASSERT_TRUE(in_view(scene.view, t.a) && in_view(scene.view, t.b) && in_view(scene.view, t.c));
}

TEST(Jevans, LumpyClustersInASmallPlaceOfUnevenExtents) {
  const Scene scene = load_scene("lumpy").scene;
  const Part creature(scene, [](const Vec3d& p) { return length(p) < 5; });
  EXPECT_GT(creature.share, 0.75);
  EXPECT_LT(volume(creature.box) / volume(scene.bounds()), 1e-6);
  EXPECT_GT(longest(creature.box.extent()) / shortest(creature.box.extent()), 2.5);
  EXPECT_GT(longest(scene.bounds().extent()) / longest(creature.box.extent()), 100);
  EXPECT_TRUE(in_view(scene.view, creature.box.lo) && in_view(scene.view, creature.box.hi));
}

TEST(Jevans, DrumClustersInASceneThatIsNotLarge) {
  const Scene scene = load_scene("drum").scene;
  EXPECT_LT(volume_holding(scene, 0.5), 0.0015);
  EXPECT_GT(volume_holding(scene, 0.9) / volume_holding(scene, 0.5), 8);
  const Part kit(scene, [](const Vec3d& p) { return p.z > 0; });
  EXPECT_GT(kit.share, 0.99);
  EXPECT_LT(longest(scene.bounds().extent()) / longest(kit.box.extent()), 1.5);
}

TEST(Jevans, TrikeHasComplexPlacesOfIrregularExtents) {
  const Scene scene = load_scene("trike").scene;
  EXPECT_LT(volume_holding(scene, 0.5), 0.002);
  const Part all(scene, [](const Vec3d& p) { return p.z > 0; });
  EXPECT_LT(longest(scene.bounds().extent()) / longest(all.box.extent()), 3);
  const Part wheel(scene, [](const Vec3d& p) {
    return std::hypot(p.x - 0.45, p.z - 0.25) < 0.26 && std::abs(p.y) < 0.05 && p.z > 0;
  });
  EXPECT_GT(wheel.share, 0.12);
  EXPECT_GT(longest(wheel.box.extent()) / shortest(wheel.box.extent()), 4);
  const Part streamers(scene, [](const Vec3d& p) { return std::abs(p.y) > 0.28 && p.z > 0.5; });
  EXPECT_GT(streamers.share, 0.1);
}

TEST(Jevans, CarIsOneRegularObjectAtTheMiddle) {
  const Scene scene = load_scene("car").scene;
  const Part car(scene, [](const Vec3d& p) { return p.z > 0.005; });
  EXPECT_GT(car.share, 0.999);
  EXPECT_LT(longest(car.box.extent()) / shortest(car.box.extent()), 3.5);
  const Vec3d offset = scene.bounds().centre() - car.box.centre();
  for (int axis = 0; axis < 3; ++axis) {
    EXPECT_LT(scene.bounds().extent()[axis] / car.box.extent()[axis], 4);
    EXPECT_LT(std::abs(offset[axis]), 0.1 * scene.bounds().extent()[axis]);
  }
}

TEST(Stadium, HasAsManyPolygonsAsAskedFor) {
  EXPECT_EQ(load_scene("stadium").scene.size(), 100'000u);
  for (const int objects : {1000, 1001, 1234, 54321})
    EXPECT_EQ(load_scene(fmt::format("stadium(objects={})", objects)).scene.size(), objects);
  EXPECT_EQ(load_scene("stadium:8(objects=5000)").scene.size(), 20'000u);
  EXPECT_EQ(load_scene("stadium:1").scene.size(), 6250u);
  EXPECT_EQ(load_scene("stadium:1(objects=5000)").scene.size(), 1000u);
  EXPECT_EQ(load_scene("stadium(objects=5000,ratio=20)").scene.id, "stadium:4/curves(objects=5000,ratio=20)");
}

TEST(Stadium, IsRatioTimesAsLongAsTheCupIsHigh) {
  for (const double ratio : {10.0, 1000.0, 1e6}) {
    const Scene scene = load_scene(fmt::format("stadium(objects=20000,ratio={})", ratio)).scene;
    const Part cup(scene, [](const Vec3d& p) { return std::hypot(p.x, p.y) < 0.4 && p.z > 0; });
    EXPECT_NEAR(longest(cup.box.extent()), 1, 1e-2);
    EXPECT_NEAR(longest(scene.bounds().extent()), ratio, 1e-9 * ratio);
  }
  const Scene scene = load_scene("stadium").scene;
  EXPECT_GT(Part(scene, [](const Vec3d& p) { return length(p) < 1.2; }).share, 0.975);
}

Vec3d tip(const Triangle<double>& sliver) { return sliver.c - (sliver.a + sliver.b) * 0.5; }

TEST(Hair, HasFiveHundredSliversTimesTheSquareOfItsSize) {
  EXPECT_EQ(load_scene("hair").scene.triangles.size(), 200'000u);
  for (const std::uint32_t size : {1u, 2u, 7u}) {
    const Scene scene = load_scene(fmt::format("hair:{}", size)).scene;
    EXPECT_EQ(scene.size(), 500 * size * size);
    EXPECT_EQ(scene.triangles.size(), scene.size());
    EXPECT_EQ(scene.groups.size(), 1 + 5 * size + 50 * size * size) << "all, bands, locks";
  }
  EXPECT_EQ(load_scene("hair:2(width=0.01)").scene.id, "hair:2/curves(width=0.01)");
}

TEST(Hair, IsLongAndThin) {
  for (const double width : {0.001, 0.02}) {
    double widths = 0, lengths = 0;
    const Scene scene = load_scene(fmt::format("hair:5(width={})", width)).scene;
    for (const Triangle<double>& sliver : scene.triangles) {
      ASSERT_GE(length(tip(sliver)), 0.2 * (1 - 1e-12));
      ASSERT_LE(length(tip(sliver)), 0.7 * (1 + 1e-12));
      ASSERT_NEAR(length(sliver.b - sliver.a), width, 0.25 * width * (1 + 1e-9));
      ASSERT_NEAR(dot(sliver.b - sliver.a, tip(sliver)), 0, 1e-12);
      widths += length(sliver.b - sliver.a), lengths += length(tip(sliver));
    }
    EXPECT_NEAR(widths / static_cast<double>(scene.size()), width, 0.01 * width);
    EXPECT_NEAR(lengths / static_cast<double>(scene.size()), 0.45, 0.01);
  }
}

TEST(Hair, StandsEvenlyOnTheUnitSphereAndLeansOutwards) {
  const Scene scene = load_scene("hair").scene;
  Vec3d mean{};
  for (const Triangle<double>& sliver : scene.triangles) {
    const Vec3d root = (sliver.a + sliver.b) * 0.5;
    ASSERT_NEAR(length(root), 1, 1e-9);
    ASSERT_GT(dot(normalized(tip(sliver)), root), 0.3);
    mean += root * (1.0 / static_cast<double>(scene.size()));
  }
  EXPECT_LT(length(mean), 1e-4);
  EXPECT_LT(volume_holding(scene, 0.9) / volume_holding(scene, 0.5), 3);
  for (int axis = 0; axis < 3; ++axis) {
    EXPECT_NEAR(scene.bounds().lo[axis], -1.68, 0.02);
    EXPECT_NEAR(scene.bounds().hi[axis], 1.68, 0.02);
  }
}

TEST(Hair, IsTheSameEveryTime) {
  const auto hash = [](const char* spec) { return scene_hash(load_scene(spec).scene); };
  EXPECT_EQ(hash("hair:3"), hash("hair:3"));
  EXPECT_NE(hash("hair:3"), hash("hair:4"));
  EXPECT_NE(hash("hair:3"), hash("hair:3(width=0.002)"));
}

}  // namespace
}  // namespace rayshoot
