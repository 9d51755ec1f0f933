#pragma once

#include "accel/parts/axis_tree.h"
#include "accel/parts/mailbox.h"
#include "scenes/core/geometry.h"

namespace rayshoot {

/// Parameters of a tree that bsp_kaplan and bsp_jansen share; bsp_kaplan's manual page explains them.
struct BspConfig {
  /// 0 for three divisions where an octree of suitable depth has one.
  int max_depth = 0;
  std::uint32_t max_objects = 8;
  MailboxUse mailbox = MailboxUse::automatic;
};

std::vector<Parameter> bsp_parameters();
BspConfig bsp_config(const Arguments& arguments);

/// Halve the scene's bounds along x, y and z in turn until the limits are reached (Kaplan 1985). An object belongs to
/// every leaf that its bounds touch. A cell is also a leaf where three divisions have separated nothing, or where
/// references would exceed 64 an object and 16 million.
template <class Real>
AxisTree<Real> build_bsp(const Geometry<Real>& geometry, const BspConfig& config);

}  // namespace rayshoot
