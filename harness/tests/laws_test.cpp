// The laws of Revelles and Ureña hold, and each check of one fails where the law is broken on purpose.
#include "harness/verify/laws.h"

#include <gmock/gmock.h>

#include "accel/algebra/expression.h"
#include "accel/core/engine_tracer.h"
#include "accel/core/registry.h"
#include "accel/tests/built_engine.h"
#include "accel/tests/conformance.h"
#include "accel/tests/nasty_scenes.h"
#include "scenes/io/load_scene.h"
#include "scenes/rays/load_rays.h"

namespace rayshoot {
namespace {

using ::testing::HasSubstr;

class BrokenLaws : public ::testing::Test {
 protected:
  /// The strict candidates of a composition, and of one that was tampered with.
  CandidateSet strict(const std::string& text, Query query = Query::strict) {
    const Arguments none;
    std::shared_ptr<Engine<double>> engine =
        compose(parse_expression(text, technique_entries())).build<double>({geometry_, none});
    return [engine, query](const Ray<double>& ray) { return candidates(*engine, query, ray); };
  }
  static CandidateSet without(std::uint32_t object, CandidateSet all) {
    return [object, all = std::move(all)](const Ray<double>& ray) {
      Objects some = all(ray);
      std::erase(some, object);
      return some;
    };
  }
  static CandidateSet with(std::uint32_t object, CandidateSet all) {
    return [object, all = std::move(all)](const Ray<double>& ray) {
      Objects more = all(ray);
      if (!std::binary_search(more.begin(), more.end(), object))
        more.insert(std::lower_bound(more.begin(), more.end(), object), object);
      return more;
    };
  }

  std::vector<VoxelContent> voxels(const std::string& text) {
    const auto optimizer =
        compose(parse_expression(text, technique_entries())).build_optimizer<double>({geometry_}, {});
    return representation(*optimizer->index());
  }

  /// An object that some ray meets first.
  std::uint32_t nearest() const {
    for (const Ray<double>& ray : rays_)
      if (const Hit<double> hit = conformance::truth(geometry_, ray).nearest; hit.object != kNoObject)
        return hit.object;
    return kNoObject;
  }

  static void expect_broken(const LawCheck& check, const std::string& violation) {
    EXPECT_FALSE(check.holds()) << check.law;
    EXPECT_THAT(check.violation, HasSubstr("ray from ("));
    EXPECT_THAT(check.violation, HasSubstr(violation));
  }

  Geometry<double> geometry_{soup_scene(120)};
  std::vector<Ray<double>> rays_ = nasty::rays(geometry_, 1, 150);
  Laws laws_{geometry_, rays_};
  const std::string lost_ = fmt::format("object {} is ", nearest());
};

TEST_F(BrokenLaws, Equation10NeedsAllObjectsOnTheRayAndNoStrangers) {
  EXPECT_TRUE(laws_.strict_optimizer("", strict("uniform_grid")).holds());
  expect_broken(laws_.strict_optimizer("", without(nearest(), strict("uniform_grid"))),
                lost_ + "in C but not in A");
  expect_broken(laws_.strict_optimizer("", with(120, strict("uniform_grid"))),
                "object 120 is in A but not in the scene");
  // What stops at the nearest hit is an optimizer, but not a strict one.
  EXPECT_FALSE(laws_.strict_optimizer("", strict("bvh_sah", Query::closest)).holds());
  EXPECT_TRUE(laws_.optimizer("", strict("bvh_sah", Query::closest)).holds());
}

TEST_F(BrokenLaws, Equation11NeedsTheNearest) {
  expect_broken(laws_.optimizer("", without(nearest(), strict("uniform_grid"))),
                lost_ + "in Cn but not in A+");
}

TEST_F(BrokenLaws, Equation12NeedsAVoxelWhereTheObjectIs) {
  std::vector<VoxelContent> all = voxels("uniform_grid");
  EXPECT_TRUE(laws_.covers("", all).holds());
  for (VoxelContent& voxel : all) std::erase(voxel.objects, nearest());
  expect_broken(laws_.covers("", all), lost_ + "met at");
  // A voxel elsewhere that lists it does not help.
  all.push_back({{{1e6, 1e6, 1e6}, {2e6, 2e6, 2e6}}, {nearest()}});
  expect_broken(laws_.covers("", all), lost_ + "met at");
}

TEST_F(BrokenLaws, Equation14NeedsTheObjectsOfTheVoxelsOnTheRayAndNoOthers) {
  const std::vector<VoxelContent> all = voxels("uniform_grid");
  EXPECT_TRUE(laws_.indexes_space("", strict("uniform_grid"), all).holds());
  expect_broken(laws_.indexes_space("", without(nearest(), strict("uniform_grid")), all),
                lost_ + "in psi but not in A");
  expect_broken(laws_.indexes_space("", strict("exhaustive"), all), "is in A but not in psi");
}

TEST_F(BrokenLaws, Equation16NeedsWhatTheSecondPartFinds) {
  const std::vector<VoxelContent> all = voxels("uniform_grid(resolution=2x2x2)");
  const auto everything = [](const Objects& objects) -> CandidateSet {
    return [objects](const Ray<double>&) { return objects; };
  };
  const std::string composition = "uniform_grid(resolution=2x2x2)|exhaustive";
  EXPECT_TRUE(laws_.sequential("", strict(composition), all, everything).holds());
  expect_broken(laws_.sequential("", without(nearest(), strict(composition)), all, everything),
                lost_ + "in the union but not in A1|A2");
  expect_broken(laws_.sequential("", strict("exhaustive"), all, everything),
                "is in A1|A2 but not in the union");
}

TEST_F(BrokenLaws, Equations18And20NeedTheSameCandidates) {
  const CandidateSet grid = strict("uniform_grid");
  EXPECT_TRUE(laws_.equal("(18)", "", grid, grid).holds());
  expect_broken(laws_.equal("(18)", "", grid, without(nearest(), grid)),
                "in the left side but not in the right side");
  expect_broken(laws_.equal("(20)", "", without(nearest(), grid), grid),
                "in the right side but not in the left side");
  // |  is not associative where the second part stands in another box.
  EXPECT_FALSE(laws_.equal("(18)", "", strict("uniform_grid(resolution=2x2x2)|uniform_grid"), grid).holds());
}

TEST_F(BrokenLaws, Equation19NeedsWhatBothHave) {
  const CandidateSet one = strict("uniform_grid"), other = strict("bvh_sah");
  EXPECT_TRUE(laws_.parallel("", strict("uniform_grid||bvh_sah"), one, other).holds());
  expect_broken(laws_.parallel("", without(nearest(), strict("uniform_grid||bvh_sah")), one, other),
                lost_ + "in both but not in A1||A2");
  expect_broken(laws_.parallel("", one, one, other), "is in A1||A2 but not in both");
}

void expect_laws(const Scene& scene) {
  const Geometry<double> geometry(scene);
  const Arguments none;
  const auto exhaustive = technique_entry("exhaustive").build<double>({geometry, none});
  std::vector<Ray<double>> rays;
  for (const char* spec : {"chords(rays=150)", "primary@9"}) {
    const RaySet set = make_rays(spec, scene, EngineTracer(*exhaustive, geometry, 1), 1);
    rays.insert(rays.end(), set.rays.begin(), set.rays.end());
  }
  int checks = 0;
  check_laws(geometry, rays, [&](const LawCheck& check) {
    ++checks;
    EXPECT_TRUE(check.holds()) << check.law << " of " << check.subject << ": " << check.violation;
  });
  EXPECT_GE(checks, 150);
}

class LawsOnScenes : public ::testing::TestWithParam<const char*> {};

TEST_P(LawsOnScenes, HoldForAllTechniquesAndExpressions) { expect_laws(load_scene(GetParam()).scene); }

INSTANTIATE_TEST_SUITE_P(Scenes, LawsOnScenes,
                         ::testing::Values("balls:2", "gears:1", "mount:4", "rings:2", "teapot:4", "tetra:4",
                                           "tree:5", "lattice:4", "stadium", "pyramid:2", "lumpy:2"),
                         [](const auto& scene) {
                           const std::string spec = scene.param;
                           return spec.substr(0, spec.find(':'));
                         });

class LawsOnRandomScenes : public ::testing::TestWithParam<int> {};

TEST_P(LawsOnRandomScenes, HoldForAllTechniquesAndExpressions) {
  nasty::Random random(static_cast<std::uint64_t>(GetParam()));
  SceneBuilder builder;
  builder.view({.from = {0, 0, -12}});
  nasty::soup(builder, random, 40 * GetParam());
  expect_laws(std::move(builder).finish());
}

INSTANTIATE_TEST_SUITE_P(Seeds, LawsOnRandomScenes, ::testing::Range(1, 6));

}  // namespace
}  // namespace rayshoot
