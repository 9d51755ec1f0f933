#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "scenes/core/scene.h"
#include "scenes/geometry/ray.h"

namespace rayshoot {

/// What must hold of every answer of a setting. Objects that a precision sets aside answer nothing: where that
/// breaks a property, the scene was refused, which is no wrong answer.
enum class Property {
  /// Graded by the exact oracle.
  as_oracle,
  /// A closed mesh seen from inside, or the like: a miss is a leak.
  always_hit,
  never_hit,
  /// The same object as ray i of the base setting, at `t_scale` times its distance, exactly.
  same_as_base
};
inline constexpr const char* kPropertyNames[] = {"as_oracle", "always_hit", "never_hit", "same_as_base"};

/// One scene with an endless supply of rays.
struct StiffSetting {
  /// What varies, as key=value, for example "level=5".
  std::string label;
  std::shared_ptr<const Scene> scene;
  /// Fill `rays` with rays number first, first + 1, …: a function of (seed, number) alone, so that batches can be
  /// made in any order and on any thread. Every number of a ray is a float, except that a ray without end keeps
  /// the largest double as its `t_max`. Only the case `garbage` makes rays that are not finite.
  std::function<void(std::uint64_t seed, std::uint64_t first, std::span<Ray<double>> rays)> rays;
  Property property = Property::as_oracle;
  double t_scale = 1;
  /// Position of the unstressed setting among those of the case: for `same_as_base`, and for ratios of work.
  std::optional<std::size_t> base;
  /// The x of the case: aspect, level, gap …
  double stiffness_parameter = 0;
  /// Number of rays of the short form; a form of size s asks for s times as many.
  std::uint64_t default_rays = 1000;
};

/// One entry of the suite STIFF: one file scenes/stiff/<id>.cpp defines one, as `stiff_<id>()`.
struct StiffCase {
  std::string id;
  /// The number of the case in the suite, 1 to 28.
  int number = 0;
  std::string title;
  std::string construction;
  /// What must hold, in words; each setting says the same as a `Property`.
  std::string property;
  std::string metric;
  /// The settings of a form: size 1 is the short one, larger sizes have more of them and larger scenes.
  std::vector<StiffSetting> (*settings)(int size, std::uint64_t seed);
};

/// All cases, sorted by id.
std::span<const StiffCase* const> stiff_cases();

}  // namespace rayshoot
