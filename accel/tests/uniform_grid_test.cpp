// What makes uniform_grid that technique: its resolution, its two storages, assignments and mailbox.
#include "accel/parts/grid_resolution.h"
#include "accel/parts/mailbox.h"
#include "accel/tests/conformance.h"
#include "accel/tests/two_caveats.h"

namespace rayshoot {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::Not;

constexpr const char* kGrid = "uniform_grid";

TEST(GridResolution, CubeRootIsTheSameAlongEveryAxis) {
  EXPECT_THAT(resolution_by_rule(ResolutionRule::cube_root, {4, 2, 1}, 1000), ElementsAre(10, 10, 10));
  EXPECT_THAT(resolution_by_rule(ResolutionRule::cube_root, {4, 2, 1}, 1500), ElementsAre(11, 11, 11))
      << "11.45";
  EXPECT_THAT(resolution_by_rule(ResolutionRule::cube_root, {4, 2, 1}, 0.01), ElementsAre(1, 1, 1));
}

TEST(GridResolution, WooHasCubesAndTheCubeRootAlongTheLongestAxis) {
  EXPECT_THAT(resolution_by_rule(ResolutionRule::woo, {4, 2, 1}, 8000), ElementsAre(20, 10, 5));
  EXPECT_THAT(resolution_by_rule(ResolutionRule::woo, {1, 4, 0}, 1000), ElementsAre(3, 10, 1)) << "2.5";
  EXPECT_THAT(resolution_by_rule(ResolutionRule::woo, {0, 0, 0}, 1000), ElementsAre(10, 10, 10));
}

/// 8000 cubes in a volume of 8 have sides of 0.1. A layer of 0.5 cannot hold cubes of (50 / 100)^(1/3) = 0.79, so 100
/// cells divide the 10x10 plane in squares of 1; 50 cells divide what is thin both ways as a line.
TEST(GridResolution, HeterogeneousHasThatNumberOfCubes) {
  const auto resolution = [](const Vec3d& extent, double cells) {
    return resolution_by_rule(ResolutionRule::heterogeneous, extent, cells);
  };
  EXPECT_THAT(resolution({4, 2, 1}, 8000), ElementsAre(40, 20, 10));
  EXPECT_THAT(resolution({10, 0.5, 10}, 100), ElementsAre(10, 1, 10));
  EXPECT_THAT(resolution({10, 0.5, 10}, 50'000), ElementsAre(100, 5, 100));
  EXPECT_THAT(resolution({0.01, 0, 1000}, 50), ElementsAre(1, 1, 50));
  EXPECT_THAT(resolution({0, 0, 0}, 1000), ElementsAre(10, 10, 10));
}

TEST(GridResolution, DensityIsThatOfCellsPerObject) {
  const ResolutionChoice choice{.rule = ResolutionRule::cube_root, .density = 5};
  EXPECT_THAT(choice.for_objects(200, {4, 2, 1}), ElementsAre(10, 10, 10));
  const Geometry<double> geometry(soup_scene(1000));
  const auto cells = [&](const Given& given) { return build(kGrid, geometry, given)->structure().nodes; };
  EXPECT_EQ(cells({{"resolution", "cube_root"}, {"density", "8"}}), 20u * 20 * 20);
  EXPECT_EQ(cells({{"resolution", "cube_root"}, {"density", "0.064"}}), 4u * 4 * 4);
}

TEST(GridResolution, IsAsGiven) {
  const Geometry<double> geometry(soup_scene(20));
  EXPECT_EQ(build(kGrid, geometry, {{"resolution", "4x3x2"}})->structure().nodes, 24u);
  const ResolutionChoice choice{.given = Resolution{46, 46, 3}};
  EXPECT_THAT(choice.for_objects(7, {1, 1, 1}), ElementsAre(46, 46, 3));
}

/// The message of a refusal.
std::string refusal(const Given& given, int objects = 20) {
  const Geometry<double> geometry(soup_scene(objects));
  try {
    build(kGrid, geometry, given);
  } catch (const InputError& error) {
    return error.what();
  }
  return "accepted";
}

TEST(GridResolution, IsRefusedWhereItIsNone) {
  for (const char* text :
       {"", "4", "4x4", "4x4x", "4x4x4x4", "0x4x4", "4x-4x4", "4x4x1000001", "4 x4x4", "woo2"})
    EXPECT_THAT(refusal({{"resolution", text}}),
                HasSubstr("resolution takes cube_root, woo, heterogeneous or three numbers"))
        << text;
  EXPECT_EQ(refusal({{"resolution", "4x4x4"}, {"density", "2"}}),
            "uniform_grid: density=2 contradicts the explicit resolution=4x4x4; give one of them");
}

TEST(UniformGrid, RefusesWhatDoesNotFitIntoMemory) {
  const std::string dense = refusal({{"resolution", "1000000x1000000x1000000"}});
  EXPECT_THAT(dense, HasSubstr("uniform_grid: a grid of 1000000x1000000x1000000 cells"));
  EXPECT_THAT(dense, HasSubstr("GiB; choose a coarser resolution or storage=hashed"));
  EXPECT_THAT(dense, Not(HasSubstr("\n")));
  const std::string hashed = refusal({{"resolution", "1000000x1000000x1000000"}, {"storage", "hashed"}});
  EXPECT_THAT(hashed, HasSubstr("GiB; choose a coarser resolution"));
  EXPECT_THAT(hashed, Not(HasSubstr("storage")));
}

/// Rays of all kinds through a soup, and what variants of the grid do with them.
class SoupGrid : public ::testing::Test {
 protected:
  static constexpr Query kQueries[] = {Query::closest, Query::any, Query::strict};

  Geometry<double> geometry_{soup_scene(300)};
  std::vector<Ray<double>> rays_ = nasty::rays(geometry_, 1, 200);
};

TEST_F(SoupGrid, BothStoragesHoldTheSame) {
  for (const char* resolution : {"heterogeneous", "30x20x10"})
    for (const char* assignment : {"box", "exact"}) {
      const auto engine = [&](const char* storage) {
        return build(kGrid, geometry_,
                     {{"resolution", resolution}, {"assignment", assignment}, {"storage", storage}});
      };
      const auto dense = engine("dense"), hashed = engine("hashed");
      const StructureStats a = dense->structure(), b = hashed->structure();
      EXPECT_EQ(a.references, b.references);
      EXPECT_EQ(a.nodes, b.nodes);
      EXPECT_EQ(a.empty_leaves, b.empty_leaves);
      for (const Query query : kQueries) {
        const auto of_dense = counted(*dense, query, rays_), of_hashed = counted(*hashed, query, rays_);
        EXPECT_EQ(of_dense.hits, of_hashed.hits);
        EXPECT_EQ(of_dense.work, of_hashed.work);
      }
    }
}

TEST_F(SoupGrid, ExactAssignmentTestsFewerObjectsAndEqualsExhaustiveSearch) {
  const auto truths = conformance::truths<double>(geometry_, rays_);
  const auto box = build(kGrid, geometry_, {{"assignment", "box"}, {"mailbox", "off"}});
  const auto exact = build(kGrid, geometry_, {{"assignment", "exact"}, {"mailbox", "off"}});
  conformance::check_engine<double>(*box, rays_, truths);
  conformance::check_engine<double>(*exact, rays_, truths);
  EXPECT_LT(exact->structure().references, box->structure().references);
  EXPECT_LT(counted(*exact, Query::strict, rays_).work.object_tests,
            counted(*box, Query::strict, rays_).work.object_tests);
}

TEST(UniformGrid, HashedCellsCostNoMemoryWhereNothingIs) {
  SceneBuilder builder;
  nasty::Random random(9);
  for (int i = 0; i < 100; ++i) builder.sphere(nasty::uniform_point(random, -4, 4), 1e-3);
  const Geometry<double> geometry(std::move(builder).finish());
  const auto bytes = [&](const char* storage) {
    return build(kGrid, geometry, {{"resolution", "200x200x200"}, {"storage", storage}})->structure().bytes;
  };
  EXPECT_GE(bytes("dense"), 4u * 200 * 200 * 200);
  EXPECT_LT(bytes("hashed"), 100'000u);
}

/// Cells that the surface of the unit ball certainly reaches, and those that it may reach, on a grid over its bounds.
std::pair<std::uint64_t, std::uint64_t> cells_of_the_unit_ball(int resolution) {
  constexpr double uncertain = 1e-9;
  std::uint64_t certainly = 0, possibly = 0;
  const auto plane = [&](int k) { return -1 + 2.0 * k / resolution; };
  for (int cell = 0; cell < resolution * resolution * resolution; ++cell) {
    const int k[] = {cell % resolution, cell / resolution % resolution, cell / resolution / resolution};
    double nearest = 0, farthest = 0;
    for (const int i : k) {
      const double lo = plane(i), hi = plane(i + 1);
      const double near = std::max({lo, -hi, 0.0}), far = std::max(std::abs(lo), std::abs(hi));
      nearest += near * near, farthest += far * far;
    }
    certainly += nearest < 1 - uncertain && farthest > 1 + uncertain;
    possibly += nearest < 1 + uncertain && farthest > 1 - uncertain;
  }
  return {certainly, possibly};
}

TEST(UniformGrid, ExactAssignmentListsASurfaceInTheCellsItReaches) {
  SceneBuilder builder;
  builder.sphere({0, 0, 0}, 1);
  const Geometry<double> geometry(std::move(builder).finish());
  const auto references = [&](const char* assignment) {
    return build(kGrid, geometry, {{"resolution", "15x15x15"}, {"assignment", assignment}})
        ->structure()
        .references;
  };
  const auto [certainly, possibly] = cells_of_the_unit_ball(15);
  EXPECT_EQ(references("box"), 15u * 15 * 15);
  EXPECT_LT(possibly, 1500u);
  EXPECT_GE(references("exact"), certainly);
  EXPECT_LE(references("exact"), possibly);
}

TEST(GridCaveats, AnObjectIsTestedOnceForARay) {
  for (const char* storage : {"dense", "hashed"}) {
    caveats::check_repeated_tests(kGrid, {{"resolution", "4x4x4"}, {"storage", storage}});
    caveats::check_mailbox_changes_no_answer(kGrid, {{"storage", storage}});
  }
}

TEST(GridCaveats, AHitBeyondTheCellDoesNotEndTheWalk) {
  for (const char* storage : {"dense", "hashed"})
    caveats::check_hit_beyond_the_voxel(kGrid, {{"resolution", "4x4x4"}, {"storage", storage}}, 4);
}

TEST(Mailbox, IsUsedByItselfWhereSomeObjectHasTwoReferences) {
  EXPECT_FALSE(wants_mailbox(MailboxUse::automatic, 10, 10));
  EXPECT_TRUE(wants_mailbox(MailboxUse::automatic, 11, 10));
  EXPECT_TRUE(wants_mailbox(MailboxUse::on, 10, 10));
  EXPECT_FALSE(wants_mailbox(MailboxUse::off, 11, 10));
}

TEST(Mailbox, KnowsWhatTheCurrentRayHasMet) {
  Mailbox mailbox(2);
  for (int ray = 0; ray < 3; ++ray) {
    mailbox.begin_ray();
    EXPECT_TRUE(mailbox.first_visit(0));
    EXPECT_FALSE(mailbox.first_visit(0));
    EXPECT_TRUE(mailbox.first_visit(1));
    EXPECT_FALSE(mailbox.first_visit(0));
  }
}

}  // namespace
}  // namespace rayshoot
