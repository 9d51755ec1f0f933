// The cost function of the adaptive 1-D grid (Jevans 1990, §6) against values computed by hand.
#include "accel/parts/grid_1d_costs.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace rayshoot {
namespace {

constexpr CodeTimings kTimings{.intcost = 100, .repcost = 10, .travcost = 7, .vertcost = 13, .subcost = 5};

/// Twelve objects of a third of the voxel, which shows a quarter of its surface across the axis.
SubdivisionCandidate candidate() {
  return {.num_objects = 12,
          .mean_object_size = 2,
          .voxel_size = 6,
          .area_beside = 0.75,
          .area_across = 0.25,
          .estimated_num_rays = 1000};
}

TEST(Grid1dCosts, AnUnsubdividedVoxelCostsItsObjects) {
  const TraversalCost cost = traversal_cost(kTimings, candidate(), 0);
  EXPECT_DOUBLE_EQ(cost.int_cost, 100 * 0.75 * 12);
  EXPECT_EQ(cost.total(), cost.int_cost);
  EXPECT_DOUBLE_EQ(new_cost(kTimings, candidate(), 0), 1000 * 900.0);
}

TEST(Grid1dCosts, ASubdividedVoxelCostsAsOnPaper) {
  // Three subvoxels of size 2: an object is in one, four objects to each.
  const TraversalCost three = traversal_cost(kTimings, candidate(), 3);
  EXPECT_DOUBLE_EQ(three.int_cost, 100 * 0.75 * 4);
  EXPECT_DOUBLE_EQ(three.trav_cost, 7 * 0.25 * 2);
  EXPECT_DOUBLE_EQ(three.rep_cost, 0);
  EXPECT_DOUBLE_EQ(three.ver_cost, 13);
  EXPECT_DOUBLE_EQ(new_cost(kTimings, candidate(), 3), 5 * 12 + 1000 * (300 + 3.5 + 13));

  // Five of size 1.2: an object is in ceil(2 / 1.2) = 2, and 12 * 2 / 5 are in each.
  const TraversalCost five = traversal_cost(kTimings, candidate(), 5);
  EXPECT_DOUBLE_EQ(five.int_cost, 100 * 0.75 * 4.8);
  EXPECT_DOUBLE_EQ(five.trav_cost, 7 * 0.25 * 4);
  EXPECT_DOUBLE_EQ(five.rep_cost, 10 * 0.25 * 1 * 12);
}

TEST(Grid1dCosts, AFlatObjectIsInOneSubvoxel) {
  SubdivisionCandidate flat = candidate();
  flat.mean_object_size = 0;
  EXPECT_DOUBLE_EQ(traversal_cost(kTimings, flat, 4).int_cost, 100 * 0.75 * 3);
  EXPECT_DOUBLE_EQ(traversal_cost(kTimings, flat, 4).rep_cost, 0);
}

TEST(Grid1dCosts, TheGranularityIsTheCheapestFromNoneToTheMaximum) {
  std::mt19937_64 random(1);
  const auto uniform = [&](double hi) { return std::ldexp(static_cast<double>(random() >> 11), -53) * hi; };
  int chosen[21] = {};
  for (int i = 0; i < 2000; ++i) {
    SubdivisionCandidate some = candidate();
    some.num_objects = std::ceil(uniform(60));
    some.mean_object_size = uniform(1) * uniform(6);
    some.area_across = uniform(1);
    some.area_beside = 1 - some.area_across;
    some.estimated_num_rays = uniform(20);
    const int cheapest = cheapest_granularity(kTimings, some, 20);
    ++chosen[cheapest];
    for (int other = 0; other <= 20; ++other) {
      const double more = new_cost(kTimings, some, other) - new_cost(kTimings, some, cheapest);
      EXPECT_TRUE(more > 0 || (more == 0 && other >= cheapest)) << other << " instead of " << cheapest;
    }
  }
  EXPECT_GT(chosen[0], 0);
  EXPECT_EQ(chosen[1], 0) << "one subvoxel is never worth entering";
  EXPECT_GT(chosen[7], 0);
  EXPECT_GT(chosen[20], 0);
}

TEST(Grid1dCosts, FewRaysDoNotPayForSorting) {
  SubdivisionCandidate some = candidate();
  some.estimated_num_rays = 0.05;
  EXPECT_EQ(cheapest_granularity(kTimings, some, 20), 0);
  some.estimated_num_rays = 1;
  EXPECT_EQ(cheapest_granularity(kTimings, some, 20), 3);
  some.estimated_num_rays = 0;
  EXPECT_EQ(cheapest_granularity(kTimings, some, 20), 0);
}

TEST(Grid1dCosts, ObjectsAsLongAsTheVoxelLeaveItWhole) {
  SubdivisionCandidate some = candidate();
  some.mean_object_size = some.voxel_size;
  EXPECT_EQ(cheapest_granularity(kTimings, some, 20), 0);
}

}  // namespace
}  // namespace rayshoot
