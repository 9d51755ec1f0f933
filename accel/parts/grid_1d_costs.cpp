#include "accel/parts/grid_1d_costs.h"

#include <algorithm>
#include <cmath>

namespace rayshoot {

TraversalCost traversal_cost(const CodeTimings& timings, const SubdivisionCandidate& candidate,
                             int num_subvoxels) {
  // §6.3: a ray that enters from the side of an unsubdivided voxel is intersected with all objects.
  const double num_objects = candidate.num_objects;
  if (num_subvoxels == 0) return {.int_cost = timings.intcost * candidate.area_beside * num_objects};

  // §6.4: a subdivided one shows it the objects of one subvoxel. Even a flat object is in one.
  const double subvoxel_size = candidate.voxel_size / num_subvoxels;
  const double num_voxels_into = std::max(1.0, std::ceil(candidate.mean_object_size / subvoxel_size));
  const double num_per_unit = num_objects * num_voxels_into / num_subvoxels;
  return {.int_cost = timings.intcost * candidate.area_beside * num_per_unit,
          .trav_cost = timings.travcost * candidate.area_across * (num_subvoxels - 1),
          .rep_cost = timings.repcost * candidate.area_across * (num_voxels_into - 1) * num_objects,
          .ver_cost = timings.vertcost * (candidate.area_beside + candidate.area_across)};
}

double new_cost(const CodeTimings& timings, const SubdivisionCandidate& candidate, int num_subvoxels) {
  const double sorting = num_subvoxels == 0 ? 0 : timings.subcost * candidate.num_objects;
  return sorting + candidate.estimated_num_rays * traversal_cost(timings, candidate, num_subvoxels).total();
}

int cheapest_granularity(const CodeTimings& timings, const SubdivisionCandidate& candidate, int maximum) {
  int cheapest = 0;
  double least = new_cost(timings, candidate, 0);
  for (int granularity = 1; granularity <= maximum; ++granularity) {
    const double cost = new_cost(timings, candidate, granularity);
    if (cost < least) cheapest = granularity, least = cost;
  }
  return cheapest;
}

}  // namespace rayshoot
