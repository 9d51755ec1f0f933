#pragma once

#include "accel/core/technique.h"

namespace rayshoot {

/// The code timings of Jevans (1990, §6.2), in nanoseconds.
struct CodeTimings {
  double intcost;   ///< performing a ray-object intersection calculation
  double repcost;   ///< repeating one: finding the signature of the ray on the object
  double travcost;  ///< iterating a ray through a subvoxel
  double vertcost;  ///< initializing a ray to traverse a subdivided voxel
  double subcost;   ///< sorting an object into a subdivided voxel
};

/// One timing by the name of its parameter.
struct NamedTiming {
  const char* name;
  double CodeTimings::*value;
  const char* what;
};
inline constexpr NamedTiming kNamedTimings[] = {
    {"intcost", &CodeTimings::intcost, "a ray-object intersection calculation"},
    {"repcost", &CodeTimings::repcost, "repeating an intersection calculation, which a mailbox prevents"},
    {"travcost", &CodeTimings::travcost, "a ray's step from a subvoxel to the next"},
    {"vertcost", &CodeTimings::vertcost, "a ray's entry into a subdivided voxel"},
    {"subcost", &CodeTimings::subcost, "sorting an object into a subdivided voxel"}};

/// What `measure_code_timings` printed where the defaults were chosen, rounded.
inline constexpr CodeTimings kDefaultTimings{
    .intcost = 16, .repcost = 1, .travcost = 5, .vertcost = 13, .subcost = 19};

/// A voxel that is a candidate for subdivision along an axis, as the cost function sees it.
struct SubdivisionCandidate {
  double num_objects = 0;
  /// Of the objects along the axis, each truncated to the voxel.
  double mean_object_size = 0;
  /// Of the voxel along the axis.
  double voxel_size = 0;
  /// The sides that contain the axis, xy and xz for x, and the side across it, yz, as parts of their sum: the
  /// fractions of rays that enter there.
  double area_beside = 0, area_across = 0;
  double estimated_num_rays = 0;
};

/// The terms of §6.4, in nanoseconds a ray.
struct TraversalCost {
  double int_cost = 0, trav_cost = 0, rep_cost = 0, ver_cost = 0;
  double total() const { return int_cost + trav_cost + rep_cost + ver_cost; }
};

/// The cost of tracing a ray through the candidate, cut into so many subvoxels; 0 leaves it whole.
TraversalCost traversal_cost(const CodeTimings& timings, const SubdivisionCandidate& candidate,
                             int num_subvoxels);

/// §6.5: the same for all rays, and sorting the objects.
double new_cost(const CodeTimings& timings, const SubdivisionCandidate& candidate, int num_subvoxels);

/// The granularity from 0 to `maximum` of least cost; of equal ones the lowest.
int cheapest_granularity(const CodeTimings& timings, const SubdivisionCandidate& candidate, int maximum);

}  // namespace rayshoot
