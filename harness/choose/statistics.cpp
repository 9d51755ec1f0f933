#include "harness/choose/statistics.h"

#include <algorithm>
#include <unordered_map>
#include <vector>

#include "accel/parts/grid_resolution.h"

namespace rayshoot {

namespace {

/// Of the centres, this part lies outside of the middle on either side of an axis.
constexpr double kTail = 0.1;

double crowding_of(const std::vector<Vec3d>& centres, const Box<double>& box) {
  const Vec3d extent = box.extent();
  const Resolution cells =
      resolution_by_rule(ResolutionRule::heterogeneous, extent, static_cast<double>(centres.size()));
  std::unordered_map<std::uint64_t, std::uint64_t> occupants;
  for (const Vec3d& centre : centres) {
    std::uint64_t cell = 0;
    for (int axis = 0; axis < 3; ++axis) {
      const auto count = static_cast<std::uint64_t>(cells[axis]);
      const double place = extent[axis] > 0 ? (centre[axis] - box.lo[axis]) / extent[axis] : 0;
      const double layer =
          std::clamp(place * static_cast<double>(count), 0.0, static_cast<double>(count - 1));
      cell = cell * count + static_cast<std::uint64_t>(layer);
    }
    ++occupants[cell];
  }
  double squares = 0;
  for (const auto& [cell, count] : occupants)
    squares += static_cast<double>(count) * static_cast<double>(count);
  return squares / static_cast<double>(centres.size());
}

double spread_of(const std::vector<Vec3d>& centres, const Box<double>& box) {
  Vec3d middle;
  std::vector<double> places(centres.size());
  for (int axis = 0; axis < 3; ++axis) {
    std::transform(centres.begin(), centres.end(), places.begin(),
                   [axis](const Vec3d& c) { return c[axis]; });
    const auto tail = static_cast<std::ptrdiff_t>(kTail * static_cast<double>(places.size()));
    const auto low = places.begin() + tail, high = places.end() - 1 - tail;
    std::nth_element(places.begin(), low, places.end());
    std::nth_element(low, high, places.end());
    middle[axis] = *high - *low;
  }
  const Vec3d whole = box.extent();
  const double inner = std::hypot(middle.x, middle.y, middle.z);
  return inner > 0 ? std::hypot(whole.x, whole.y, whole.z) / inner : 1;
}

}  // namespace

std::map<std::string, double> SceneStatistics::by_name() const {
  return {{"objects", objects}, {"crowding", crowding}, {"spread", spread}};
}

template <class Real>
SceneStatistics statistics_of(const Geometry<Real>& geometry) {
  if (geometry.size() == 0) return {};
  const Box<Real>& bounds = geometry.bounds();
  const Box<double> box{Vec3d(bounds.lo), Vec3d(bounds.hi)};
  std::vector<Vec3d> centres;
  for (std::uint32_t object = 0; object < geometry.size(); ++object) {
    const Box<Real> around = geometry.bounds(object);
    centres.push_back((Vec3d(around.lo) + Vec3d(around.hi)) * 0.5);
  }
  return {geometry.numbers(), crowding_of(centres, box), spread_of(centres, box)};
}

template SceneStatistics statistics_of(const Geometry<float>&);
template SceneStatistics statistics_of(const Geometry<double>&);

}  // namespace rayshoot
