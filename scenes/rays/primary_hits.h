#pragma once

#include "scenes/rays/ray_tree.h"

namespace rayshoot {

/// What the eye sees of a scene: the surface points that the rays of `primary` hit, row by row.
std::vector<Encounter> primary_hits(const RayRequest& request);

/// The parameter `resolution` of all distributions that start from eye rays.
Parameter resolution_parameter();

}  // namespace rayshoot
