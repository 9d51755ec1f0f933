#pragma once

#include <span>
#include <string>
#include <vector>

#include "scenes/core/geometry.h"
#include "scenes/core/spec.h"
#include "scenes/rays/ray_set.h"

namespace rayshoot {

/// What a ray distribution needs to know nearest hits: scenes do not trace, so whoever generates rays brings
/// a tracer. Objects in hits are numbered as in the scene.
class Tracer {
 public:
  virtual ~Tracer() = default;
  virtual void closest(std::span<const Ray<double>> rays, std::span<Hit<double>> hits) const = 0;
  virtual void any(std::span<const Ray<double>> rays, std::span<std::uint8_t> blocked) const = 0;
};

/// All a distribution is given. `tracer` sees the scene with the cone sides that the distribution asks for.
struct RayRequest {
  const Scene& scene;
  const Tracer& tracer;
  const Arguments& arguments;
  std::uint64_t seed = 1;
};

/// A way to choose rays: the probability measure P of Revelles' M, equation (21). One file under
/// scenes/rays/distributions/ defines one, as `rays_<file name>()`.
struct RayDistribution {
  std::string id;
  std::string title;
  std::string source;
  std::vector<Parameter> parameters;
  /// Whether the scene must have point lights.
  bool needs_lights = false;
  /// Which sides of cones the rays were generated for, and hence must be traced with.
  ConeSides (*cone_sides)(const Arguments& arguments);
  RaySet (*generate)(const RayRequest& request);
};

/// All distributions, sorted by id.
std::span<const RayDistribution* const> ray_distributions();

}  // namespace rayshoot
