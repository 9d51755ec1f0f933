#pragma once

#include "scenes/rays/ray_tree.h"

namespace rayshoot {

/// The eye rays of a request, row by row: on the grid of the rules, with times where something moves.
std::vector<Ray<double>> eye_rays_of(const RayRequest& request, const RayTreeRules& rules);

/// What the eye sees of a scene: the surface points that the rays of `primary` hit, row by row.
std::vector<Encounter> primary_hits(const RayRequest& request);

/// The parameter `resolution` of all distributions that start from eye rays.
Parameter resolution_parameter();

}  // namespace rayshoot
