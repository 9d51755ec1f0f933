// The bricks of grids: planes, the walk from cell to cell, lists of objects.
#include "accel/parts/grid_walk.h"

#include <gmock/gmock.h>

#include "accel/parts/cell_lists.h"
#include "accel/tests/conformance.h"
#include "accel/tests/nasty_scenes.h"

namespace rayshoot {
namespace {

using nasty::Random;
using ::testing::ElementsAre;
using ::testing::IsEmpty;

template <class T>
class GridWalkOf : public ::testing::Test {};
using Scalars = ::testing::Types<float, double>;
TYPED_TEST_SUITE(GridWalkOf, Scalars);

template <class Real>
Interval<Real> inside(const Crossings<Real>& crossings, const GridPlanes<Real>& grid, std::uint64_t cell) {
  return crossings.inside(grid.box(grid.block(cell)));
}

template <class Real>
std::vector<std::uint64_t> walked(const GridPlanes<Real>& grid, const Ray<Real>& ray) {
  std::vector<std::uint64_t> cells;
  const auto reach = [&] { return ray.t_max; };
  walk_grid(grid, ray, Crossings<Real>(ray), NoCount{}, reach, [&](std::uint64_t cell) {
    cells.push_back(cell);
    return false;
  });
  return cells;
}

/// All cells in which a hit can lie, by the intervals of every cell.
template <class Real>
std::vector<std::uint64_t> pierced(const GridPlanes<Real>& grid, const Ray<Real>& ray) {
  std::vector<std::uint64_t> cells;
  const Crossings<Real> crossings(ray);
  for (std::uint64_t cell = 0; cell < grid.cells(); ++cell) {
    const auto [enter, exit] = inside(crossings, grid, cell);
    const bool nonempty = enter <= exit && ray.t_min < ray.t_max;
    if (nonempty && exit > ray.t_min && enter <= ray.t_max) cells.push_back(cell);
  }
  return cells;
}

/// A grid whose planes lie on integers, on thirds, anywhere, or, far away, on top of one another.
template <class Real>
GridPlanes<Real> random_grid(Random& random) {
  const auto pick = [&](int lo, int hi) { return std::uniform_int_distribution<int>(lo, hi)(random); };
  const Resolution resolution{pick(1, 6), pick(1, 6), pick(1, 6)};
  const double unit = std::array{1.0, 1.0 / 3, nasty::uniform(random, 0.01, 1)}[pick(0, 2)];
  const double far = pick(0, 3) == 0 ? std::pow(10.0, pick(3, std::is_same_v<Real, float> ? 7 : 15)) : 0;
  const Vec3d lo = nasty::lattice_point(random, -3, 3) + Vec3d{far, -far, far / 3};
  const Vec3d size{unit * resolution[0], unit * resolution[1], unit * resolution[2]};
  return {{Vec3<Real>(lo), Vec3<Real>(lo + size)}, resolution};
}

/// A ray from or to the corners, edges and planes of a grid's cells, from nearby or far away.
template <class Real>
Ray<Real> random_ray(const GridPlanes<Real>& grid, Random& random) {
  const auto pick = [&](int lo, int hi) { return std::uniform_int_distribution<int>(lo, hi)(random); };
  const Vec3d lo(grid.bounds().lo), extent = Vec3d(grid.bounds().hi) - lo;
  const auto point = [&](double beyond) {
    Vec3d p;
    for (int axis = 0; axis < 3; ++axis) {
      const double free = lo[axis] + extent[axis] * nasty::uniform(random, -beyond, 1 + beyond);
      p[axis] = pick(0, 1) ? free : double(grid.planes(axis)[pick(0, grid.resolution()[axis])]);
    }
    return p;
  };
  const Vec3d from = pick(0, 5) == 0 ? nasty::uniform_point(random, -1e5, 1e5) : point(pick(0, 1));
  Vec3d along = pick(0, 1) ? nasty::lattice_point(random, -1, 1) : point(0) - from;
  if (pick(0, 4) == 0) along[pick(0, 2)] = pick(0, 1) ? 0.0 : -0.0;
  if (pick(0, 9) == 0) along[pick(0, 2)] = std::numeric_limits<Real>::denorm_min();
  Ray<Real> ray{.origin = Vec3<Real>(from), .direction = Vec3<Real>(along)};
  if (pick(0, 3) == 0) ray.t_min = static_cast<Real>(pick(0, 4) * 0.25);
  if (pick(0, 3) == 0) ray.t_max = static_cast<Real>(pick(0, 8) * 0.25);
  return ray;
}

TYPED_TEST(GridWalkOf, VisitsExactlyTheCellsInWhichAHitCanLie) {
  Random random(1);
  int rays_with_ties = 0;
  for (int i = 0; i < 4000; ++i) {
    const auto grid = random_grid<TypeParam>(random);
    for (int k = 0; k < 25; ++k) {
      const auto ray = random_ray(grid, random);
      std::vector<std::uint64_t> cells = walked(grid, ray);

      // Near to far, as far as the order of crossings is certain.
      const Crossings<TypeParam> crossings(ray);
      for (std::size_t c = 1; c < cells.size(); ++c) {
        const TypeParam before = std::max(inside(crossings, grid, cells[c - 1]).enter, ray.t_min);
        const auto [enter, exit] = inside(crossings, grid, cells[c]);
        ASSERT_LE(before, std::max(exit, enter) * kApart<TypeParam>);
      }

      const auto steps = cells.size();
      std::sort(cells.begin(), cells.end());
      ASSERT_EQ(cells, pierced(grid, ray)) << conformance::describe(ray);
      const auto& [nx, ny, nz] = grid.resolution();
      rays_with_ties += steps > static_cast<std::size_t>(nx + ny + nz - 2);
    }
  }
  EXPECT_GT(rays_with_ties, 100) << "a walk from neighbour to neighbour cannot visit that many cells";
}

TEST(GridWalk, StepsOverOneFaceAtATime) {
  const GridPlanes<double> grid({{0, 0, 0}, {3, 3, 1}}, {3, 3, 1});
  EXPECT_THAT(walked<double>(grid, {.origin = {0.7, -1, 0.5}, .direction = {0.5, 1, 0}}),
              ElementsAre(1, 4, 5, 8));
  EXPECT_THAT(walked<double>(grid, {.origin = {2.5, 0.5, 0.5}, .direction = {-1, 0, 0}}),
              ElementsAre(2, 1, 0));
  EXPECT_THAT(walked<double>(grid, {.origin = {4, 0.5, 0.5}, .direction = {1, 0, 0}}), IsEmpty());
}

TEST(GridWalk, VisitsAllCellsAroundAnEdgeAndACorner) {
  const GridPlanes<double> grid({{0, 0, 0}, {2, 2, 2}}, {2, 2, 2});
  EXPECT_THAT(walked<double>(grid, {.origin = {0.5, 0.5, 0.5}, .direction = {1, 1, 0}}),
              ElementsAre(0, 1, 2, 3));
  EXPECT_THAT(walked<double>(grid, {.origin = {-1, -1, -1}, .direction = {1, 1, 1}}),
              ElementsAre(0, 1, 2, 3, 4, 5, 6, 7));
  EXPECT_THAT(walked<double>(grid, {.origin = {-1, 0, 0.5}, .direction = {1, 1, 0}}), ElementsAre(0, 2, 3))
      << "comes in through an edge";
}

TEST(GridWalk, GoesNoFurtherThanTheReach) {
  const GridPlanes<double> grid({{0, 0, 0}, {4, 1, 1}}, {4, 1, 1});
  Ray<double> ray{.origin = {0, 0.5, 0.5}, .direction = {1, 0, 0}, .t_max = 1.5};
  EXPECT_THAT(walked(grid, ray), ElementsAre(0, 1));
  ray.t_max = 2;
  EXPECT_THAT(walked(grid, ray), ElementsAre(0, 1, 2)) << "a hit of a lower object at 2 may lie in cell 2";
  ray.t_min = 1;
  EXPECT_THAT(walked(grid, ray), ElementsAre(0, 1, 2)) << "the plane at 1 may be crossed a little later";
  ray.t_min = 1.001;
  EXPECT_THAT(walked(grid, ray), ElementsAre(1, 2));
}

TEST(GridWalk, EndsForRaysThatAreNone) {
  const GridPlanes<float> grid({{0, 0, 0}, {1, 1, 1}}, {9, 9, 9});
  const float numbers[] = {0,
                           0.5,
                           -1,
                           std::numeric_limits<float>::quiet_NaN(),
                           Box<float>::infinity(),
                           -Box<float>::infinity(),
                           std::numeric_limits<float>::max()};
  for (const float a : numbers)
    for (const float b : numbers)
      for (const float c : numbers)
        for (const float d : numbers)
          EXPECT_LE(
              walked<float>(grid, {.origin = {a, 0.5, b}, .direction = {c, d, 1}, .t_max = kMiss<float>})
                  .size(),
              9u * 9 * 9);
}

TYPED_TEST(GridWalkOf, PlanesBeginAndEndWithTheBoxAndNeverDecrease) {
  Random random(2);
  for (int i = 0; i < 1000; ++i) {
    const auto grid = random_grid<TypeParam>(random);
    for (int axis = 0; axis < 3; ++axis) {
      const auto& planes = grid.planes(axis);
      EXPECT_EQ(planes.front(), grid.bounds().lo[axis]);
      EXPECT_EQ(planes.back(), grid.bounds().hi[axis]);
      EXPECT_TRUE(std::is_sorted(planes.begin(), planes.end()));
    }
  }
}

TYPED_TEST(GridWalkOf, ABoxOverlapsTheCellsWithWhichItSharesAPoint) {
  Random random(3);
  for (int i = 0; i < 3000; ++i) {
    const auto grid = random_grid<TypeParam>(random);
    const Vec3<TypeParam> a = random_ray(grid, random).origin, b = random_ray(grid, random).origin;
    Box<TypeParam> box{min(a, b), max(a, b)};
    if (!box.overlaps(grid.bounds())) continue;
    const CellRange range = grid.overlapped_by(box);
    const auto& [nx, ny, nz] = grid.resolution();
    for (std::int32_t z = 0; z < nz; ++z)
      for (std::int32_t y = 0; y < ny; ++y)
        for (std::int32_t x = 0; x < nx; ++x) {
          const std::array cell{x, y, z};
          bool in_range = true;
          for (int axis = 0; axis < 3; ++axis)
            in_range &= range.first[axis] <= cell[axis] && cell[axis] <= range.last[axis];
          ASSERT_EQ(in_range, grid.box({cell, cell}).overlaps(box));
        }
  }
}

TEST(CellLists, KeepTheObjectsOfEveryCellInOrder) {
  // Object i belongs to the cells that divide it, whatever thread puts it there.
  constexpr std::uint32_t objects = 20'000;
  const auto divisors = [](std::uint32_t object, const auto& visit) {
    for (std::uint64_t cell = 1; cell < 100; ++cell)
      if (object % cell == 0) visit(cell);
  };
  const CellLists dense(100, objects, divisors);
  const HashedCellLists hashed(objects, divisors);
  for (std::uint64_t cell = 0; cell < 100; ++cell) {
    std::vector<std::uint32_t> multiples;
    for (std::uint32_t object = 0; cell > 0 && object < objects; object += static_cast<std::uint32_t>(cell))
      multiples.push_back(object);
    EXPECT_THAT(dense.objects(cell), ::testing::ElementsAreArray(multiples));
    EXPECT_THAT(hashed.objects(cell), ::testing::ElementsAreArray(multiples));
  }
  EXPECT_THAT(hashed.objects(123'456'789'012), IsEmpty());
  EXPECT_EQ(dense.occupied(), 99u);
  EXPECT_EQ(hashed.occupied(), 99u);
  EXPECT_EQ(dense.references(), hashed.references());
}

}  // namespace
}  // namespace rayshoot
