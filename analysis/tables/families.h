#pragma once

#include <map>
#include <string>
#include <vector>

#include "analysis/tables/groups.h"

namespace rayshoot::analysis {

/// Fewer sizes of a scene say nothing about growth.
inline constexpr std::size_t kLeastSizes = 3;

/// A scene in several sizes, and with the same arguments otherwise, seen by one distribution of rays in one precision.
struct Family {
  /// For example "balls as patches", "primary@257", "float".
  std::string scene, rays, precision;
  std::map<std::uint64_t, const Group*> by_objects;
};

/// Families of enough sizes, in the order of the groups, which must outlive them.
std::vector<Family> families(const std::vector<Group>& groups);

}  // namespace rayshoot::analysis
