// What is expected of hierarchies of volumes: equation (3) with the chances of sampled rays, and end-point overlap.
#include <gmock/gmock.h>

#include "accel/core/registry.h"
#include "accel/parts/sah_build.h"
#include "harness/measure/end_point_overlap.h"
#include "harness/measure/predicting.h"
#include "harness/measure/tested_kinds.h"
#include "harness/verify/scene_tracer.h"
#include "scenes/core/scene_builder.h"
#include "scenes/io/load_scene.h"
#include "scenes/rays/load_rays.h"

namespace rayshoot {
namespace {

using ::testing::IsEmpty;
using ::testing::SizeIs;

constexpr const char* kHierarchies[] = {"bvh_sah",         "bvh_wide",          "bvh_goldsmith_salmon",
                                        "bvh_kay_kajiya",  "bvh_rubin_whitted", "bvh_weghorst",
                                        "bounding_volumes"};

template <class Real>
std::unique_ptr<Engine<Real>> built(const std::string& id, const Geometry<Real>& geometry,
                                    const std::map<std::string, std::string>& given = {}) {
  const TechniqueEntry& entry = technique_entry(id);
  return entry.build<Real>({geometry, Arguments(entry.info.parameters, given, id)});
}

/// A scene and its ray tree, every ray four times over: whichever ray of four is chosen, the sample is the same.
class SampledEquation3 : public ::testing::TestWithParam<const char*> {
 protected:
  SampledEquation3()
      : scene_(load_scene(GetParam()).scene),
        geometry_(scene_),
        batch_(fourfold(scene_)),
        known_(geometry_, batch_, 1, 2) {}

  static RaySet fourfold(const Scene& scene) {
    const SceneTracer tracer(scene, ConeSides::both, 2);
    const RaySet set = make_rays("whitted@17", scene, tracer.tracer(), 1);
    RaySet result = set;
    result.rays.clear(), result.origins.clear();
    for (std::size_t i = 0; i < set.rays.size(); ++i) {
      result.rays.insert(result.rays.end(), 4, set.rays[i]);
      result.origins.insert(result.origins.end(), 4, set.origins[i]);
    }
    result.closest_rays = 4 * set.closest_rays;
    return result;
  }
  report::Predicted counted(const Engine<float>& engine, Query closest, Query any) const {
    ThreadScratch<float> scratch(engine);
    std::vector<Hit<float>> hits(batch_.rays.size());
    const std::span all(hits);
    CountedWork sum =
        count_work(engine, closest, batch_.closest(), all.first(batch_.closest_rays), scratch, 1);
    sum += count_work(engine, any, batch_.any(), all.subspan(batch_.closest_rays), scratch, 1);
    const auto rays = static_cast<double>(sum.total.rays);
    return {static_cast<double>(sum.total.object_tests) / rays,
            static_cast<double>(sum.total.volume_tests) / rays};
  }
  static void expect_equal(const report::Predicted& a, const report::Predicted& b, const std::string& what) {
    EXPECT_NEAR(a.object_tests_per_ray, b.object_tests_per_ray, 1e-9 * b.object_tests_per_ray) << what;
    EXPECT_NEAR(a.volume_tests_per_ray, b.volume_tests_per_ray, 1e-9 * b.volume_tests_per_ray) << what;
  }

  Scene scene_;
  Geometry<float> geometry_;
  Batch<float> batch_;
  KnownRays<float> known_;
};

/// For the sampled rays it is what a search does, order and all; without occlusion it is the strict optimizer.
TEST_P(SampledEquation3, IsExactForTheSampledRays) {
  for (const char* id : kHierarchies) {
    const auto engine = built<float>(id, geometry_);
    const auto prediction = known_.predict(*engine, 2);
    ASSERT_TRUE(prediction) << id;
    EXPECT_EQ(prediction->sampled_rays * 4, batch_.rays.size()) << id;
    expect_equal(prediction->ordered, counted(*engine, Query::closest, Query::any), id);
    expect_equal(prediction->unoccluded, counted(*engine, Query::strict, Query::strict), id);
  }
}

/// The chances are those of equation (3): summed over the nodes of the binary tree, the share of rays that enter a node no
/// farther away than their nearest hit, times what is tested when it is entered.
TEST_P(SampledEquation3, IsASumOverVolumes) {
  auto objects = boxed_objects(geometry_);
  const PairTree<float> tree = sah_tree<float>(objects, SahConfig{});
  const auto reference = built<float>("exhaustive", geometry_);
  std::vector<Ray<float>> rays = batch_.rays;
  std::vector<Hit<float>> hits(rays.size());
  reference->closest(rays, hits, *reference->scratch());
  for (std::size_t i = 0; i < rays.size(); ++i)
    if (hits[i].object != kNoObject) rays[i].t_max = hits[i].t;

  double volume_tests = 1, object_tests = 0;
  const auto chance = [&](const Box<float>& box) {
    const auto enters = [&](const Ray<float>& ray) {
      const Interval<float> inside = Crossings<float>(ray).inside(box);
      return std::max(inside.enter, ray.t_min) <= std::min(inside.exit, ray.t_max);
    };
    return static_cast<double>(std::count_if(rays.begin(), rays.end(), enters)) /
           static_cast<double>(rays.size());
  };
  const auto add = [&](const auto& self, const ChildReference& node, const Box<float>& box) -> void {
    if (node.leaf()) {
      object_tests += chance(box) * node.count;
      return;
    }
    volume_tests += chance(box) * 2;
    for (int side = 0; side < 2; ++side)
      self(self, tree.nodes[node.first].child[side], tree.nodes[node.first].boxes.box(side));
  };
  add(add, tree.root, tree.bounds);
  expect_equal(known_.predict(*built<float>("bvh_sah", geometry_), 2)->occluded, {object_tests, volume_tests},
               "");
}

/// Knowing the nearest hit from the start saves tests, not knowing any hit costs them.
TEST_P(SampledEquation3, OrderLiesBetweenKnowingAllAndNothing) {
  for (const char* id : kHierarchies) {
    RaySet nearest = fourfold(scene_);
    nearest.rays.resize(nearest.closest_rays), nearest.origins.resize(nearest.closest_rays);
    const KnownRays<float> known(geometry_, Batch<float>(nearest), 1, 2);
    const auto prediction = known.predict(*built<float>(id, geometry_), 2);
    EXPECT_LE(prediction->occluded.object_tests_per_ray, prediction->ordered.object_tests_per_ray) << id;
    EXPECT_LE(prediction->occluded.volume_tests_per_ray, prediction->ordered.volume_tests_per_ray) << id;
    EXPECT_LE(prediction->ordered.object_tests_per_ray, prediction->unoccluded.object_tests_per_ray) << id;
    EXPECT_LE(prediction->ordered.volume_tests_per_ray, prediction->unoccluded.volume_tests_per_ray) << id;
  }
}

TEST_P(SampledEquation3, SpeaksOfHierarchiesAlone) {
  for (const char* id : {"uniform_grid", "kd_tree", "exhaustive"})
    EXPECT_FALSE(known_.predict(*built<float>(id, geometry_), 2)) << id;
  EXPECT_FALSE(known_.predict(*built<float>("bounding_volumes", geometry_, {{"combination", "union"}}), 2));
}

INSTANTIATE_TEST_SUITE_P(Scenes, SampledEquation3,
                         ::testing::Values("balls:2", "mount:3", "gears:1", "tree:4"), [](const auto& scene) {
                           const std::string spec = scene.param;
                           return spec.substr(0, spec.find(':'));
                         });

TEST(KnownRays, AreAFractionOfMany) {
  const Scene scene = load_scene("balls:1").scene;
  const Geometry<float> geometry(scene);
  RaySet set;
  set.rays.assign(100'000, {.origin = {0, 0, 9}, .direction = {0, 0, -1}});
  set.origins.resize(set.rays.size());
  set.closest_rays = 60'000;
  const auto prediction =
      KnownRays<float>(geometry, Batch<float>(set), 1, 2).predict(*built<float>("bvh_sah", geometry), 2);
  EXPECT_LE(prediction->sampled_rays, 16'385u);
  EXPECT_GE(prediction->sampled_rays, 12'000u);
}

/// Spheres along a line that do not touch.
Scene row_of_spheres() {
  SceneBuilder builder;
  for (int i = 0; i < 20; ++i) builder.sphere({4.0 * i, 0, 0}, 1);
  return std::move(builder).finish();
}

/// Volumes that do not overlap hold no other object at any point of a surface.
TEST(EndPointOverlap, IsNothingWhereVolumesDoNotOverlap) {
  const Scene scene = row_of_spheres();
  const Geometry<double> geometry(scene);
  const auto points = surface_points(geometry, 1000, 1);
  for (const char* id : {"bvh_sah", "bvh_wide", "bounding_volumes"}) {
    const auto overlap = end_point_overlap(*built<double>(id, geometry), geometry, points, 2);
    ASSERT_TRUE(overlap) << id;
    EXPECT_EQ(overlap->points, 1000u);
    EXPECT_EQ(overlap->object_tests_per_point, 0) << id;
    EXPECT_EQ(overlap->volume_tests_per_point, 0) << id;
  }
  EXPECT_FALSE(end_point_overlap(*built<double>("uniform_grid", geometry), geometry, points, 2));
}

/// The definition, point by point: the nodes about a point that are not about its object.
TEST(EndPointOverlap, IsASumOverNodes) {
  for (const char* spec : {"balls:2", "gears:1", "tree:4"}) {
    const Scene scene = load_scene(spec).scene;
    const Geometry<double> geometry(scene);
    const auto points = surface_points(geometry, 2000, 7);
    auto objects = boxed_objects(geometry);
    const PairTree<double> tree = sah_tree<double>(objects, SahConfig{});
    double volume_tests = 0, object_tests = 0;
    for (const SurfacePoint& point : points) {
      const auto holds = [&](const auto& self, const ChildReference& node) -> bool {
        if (!node.leaf())
          return self(self, tree.nodes[node.first].child[0]) || self(self, tree.nodes[node.first].child[1]);
        return std::any_of(objects.begin() + node.first, objects.begin() + node.first + node.count,
                           [&](const auto& boxed) { return boxed.object == point.object; });
      };
      const auto add = [&](const auto& self, const ChildReference& node, const Box<double>& box) -> void {
        for (int axis = 0; axis < 3; ++axis)
          if (point.point[axis] < box.lo[axis] || point.point[axis] > box.hi[axis]) return;
        if (!holds(holds, node)) (node.leaf() ? object_tests : volume_tests) += node.leaf() ? node.count : 2;
        if (node.leaf()) return;
        for (int side = 0; side < 2; ++side)
          self(self, tree.nodes[node.first].child[side], tree.nodes[node.first].boxes.box(side));
      };
      add(add, tree.root, tree.bounds);
    }
    const auto overlap = end_point_overlap(*built<double>("bvh_sah", geometry), geometry, points, 2);
    const auto count = static_cast<double>(points.size());
    EXPECT_GT(volume_tests, 0) << spec;
    EXPECT_NEAR(overlap->volume_tests_per_point, volume_tests / count, 0.01 * volume_tests / count) << spec;
    EXPECT_NEAR(overlap->object_tests_per_point, object_tests / count, 0.01 * object_tests / count) << spec;
  }
}

/// A ray that ends at a point of an object is put to all that the object's own volumes cost, in every hierarchy.
TEST(EndPointOverlap, OwnVolumesAreEntered) {
  const Scene scene = load_scene("gears:1").scene;
  const Geometry<float> geometry(scene);
  for (const char* id : kHierarchies) {
    const auto engine = built<float>(id, geometry);
    const std::vector<PathTests> paths = engine->path_tests();
    ASSERT_THAT(paths, SizeIs(geometry.size())) << id;
    for (const PathTests& path : paths) {
      ASSERT_GE(path.object_tests, 1u) << id;
      ASSERT_GE(path.volume_tests, 1u) << id;
    }
    for (const SurfacePoint& point : surface_points(geometry, 200, 3)) {
      const Vec3d back{0.6, 0.48, 0.64};
      const Ray<float> ray{
          .origin = Vec3<float>(point.point - back * 1e-4), .direction = Vec3<float>(back), .t_max = 2e-4f};
      Hit<float> hit;
      const Work work = engine->count(Query::strict, {&ray, 1}, {&hit, 1}, *engine->scratch()).total;
      ASSERT_GE(work.object_tests, paths[point.object].object_tests) << id;
      ASSERT_GE(work.volume_tests, paths[point.object].volume_tests) << id;
    }
  }
  EXPECT_THAT(built<float>("uniform_grid", geometry)->path_tests(), IsEmpty());
  EXPECT_THAT(built<float>("bvh_goldsmith_salmon", geometry, {{"object_volumes", "off"}})->path_tests(),
              SizeIs(geometry.size()));
}

/// Of the candidates of a flat list everything is known: each ray has every object.
TEST(TestedKinds, AreSharesOfTheCandidates) {
  SceneBuilder builder;
  for (int i = 0; i < 2; ++i) builder.sphere({4.0 * i, 0, 0}, 1);
  builder.triangle({5, 0, 0}, {9, 0, 0}, {5, 2, 0});
  builder.polygon(std::vector<Vec3d>{{40, 0, 1}, {44, 0, 1}, {44, 4, 1}, {42, 5, 1}, {40, 4, 1}});
  const Scene scene = std::move(builder).finish();
  const Geometry<double> geometry(scene);
  RaySet set;
  set.rays.assign(100, {.origin = {0, 0, 9}, .direction = {0, 0, -1}});
  set.origins.resize(set.rays.size());
  set.closest_rays = 60;
  const auto engine = built<double>("exhaustive", geometry);
  const auto kinds = record(tested_kinds(*engine, geometry, Batch<double>(set), 400, *engine->scratch()));
  ASSERT_TRUE(kinds);
  // An any-hit query ends at the first sphere.
  EXPECT_DOUBLE_EQ(kinds->spheres, (60 * 2 + 40) / 280.0);
  EXPECT_DOUBLE_EQ(kinds->triangles, 60 / 280.0);
  EXPECT_DOUBLE_EQ(kinds->polygons, 60 / 280.0);
  EXPECT_DOUBLE_EQ(kinds->polygon_vertices, 5 * 60 / 280.0);
  EXPECT_EQ(kinds->cones, 0);
  EXPECT_FALSE(record(TestedKinds{}));
}

/// Points lie on the object that they are said to be of, as often as it has area.
TEST(SurfacePoints, AreOnTheSurfacesByArea) {
  SceneBuilder builder;
  builder.sphere({0, 0, 0}, 1);
  builder.triangle({5, 0, 0}, {9, 0, 0}, {5, 2, 0});
  builder.cone({20, 0, 0}, 2, {20, 3, 4}, 1);
  // Not convex, of the area 4.
  const std::vector<Vec3d> corners{{40, 0, 1}, {44, 0, 1}, {44, 4, 1}, {43, 1, 1}};
  builder.polygon(corners);
  const Scene scene = std::move(builder).finish();
  const Geometry<double> geometry(scene);
  std::vector<std::size_t> of_object(4);
  int met = 0;
  for (const SurfacePoint& point : surface_points(geometry, 20'000, 5)) {
    ++of_object[point.object];
    const Box<double> box = geometry.bounds(point.object);
    for (int axis = 0; axis < 3; ++axis) {
      EXPECT_GE(point.point[axis], box.lo[axis]);
      EXPECT_LE(point.point[axis], box.hi[axis]);
    }
    // A short ray through the point meets the object there.
    const Vec3d direction{0.9, 0.3, 1};
    const Ray<double> ray{.origin = point.point - direction * 1e-6, .direction = direction, .t_max = 2e-6};
    met += geometry.hit_distance(point.object, ray) <= ray.t_max;
  }
  EXPECT_GE(met, 19'950) << "but for those at the edges, and where the ray runs along the surface";
  const double pi = 3.14159265358979, areas[] = {4 * pi, 4, 3 * pi * std::sqrt(26), 4};
  const double all = areas[0] + areas[1] + areas[2] + areas[3];
  for (int object = 0; object < 4; ++object)
    EXPECT_NEAR(static_cast<double>(of_object[object]) / 20'000, areas[object] / all, 2e-4) << object;
}

}  // namespace
}  // namespace rayshoot
