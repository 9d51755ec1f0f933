#pragma once

#include <map>
#include <string>

#include "scenes/core/geometry.h"

namespace rayshoot {

/// What can be told of a scene at a glance, before anything is built.
struct SceneStatistics {
  std::uint32_t objects = 0;
  /// Objects whose centres share the cell of an object, itself included, on average over objects: in a grid of cubes with
  /// as many cells as there are objects. 2 where centres are random; all of them for a cup in a stadium.
  double crowding = 0;
  /// Diagonal of the scene over that of the box in which the middle eight tenths of the centres lie, axis by axis.
  double spread = 1;

  /// By the names that reports use.
  std::map<std::string, double> by_name() const;
};

template <class Real>
SceneStatistics statistics_of(const Geometry<Real>& geometry);

}  // namespace rayshoot
