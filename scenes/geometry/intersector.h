#pragma once

#include <algorithm>
#include <array>
#include <string_view>

namespace rayshoot {

/// Which ray-object test triangles and polygons get; spheres and cones share no edges and have one.
///   fast        after Möller and Trumbore, in double precision; a ray aimed at an edge or a vertex may slip between
///               two triangles
///   watertight  after Woop, Benthin and Wald: none does
///   exact       triangles and polygons decided, and triangles measured, by exact arithmetic
enum class Intersector { fast, watertight, exact };
inline constexpr std::array kIntersectorNames = {"fast", "watertight", "exact"};

/// The intersector of that name, one of `kIntersectorNames`.
inline Intersector intersector_named(std::string_view name) {
  const auto found = std::find(kIntersectorNames.begin(), kIntersectorNames.end(), name);
  return static_cast<Intersector>(found - kIntersectorNames.begin());
}

}  // namespace rayshoot
