#pragma once

#include <stdexcept>

#include "scenes/stiff/stiff_case.h"

namespace rayshoot {

inline const StiffCase& stiff_case(const std::string& id) {
  for (const StiffCase* entry : stiff_cases())
    if (entry->id == id) return *entry;
  throw std::out_of_range(id);
}

/// The settings of the short form.
inline std::vector<StiffSetting> settings_of(const std::string& id) { return stiff_case(id).settings(1, 3); }

inline const StiffSetting& setting_of(const std::vector<StiffSetting>& settings, const std::string& label) {
  for (const StiffSetting& setting : settings)
    if (setting.label == label) return setting;
  throw std::out_of_range(label);
}

inline std::vector<Ray<double>> rays_of(const StiffSetting& setting, std::size_t count,
                                        std::uint64_t first = 0, std::uint64_t seed = 7) {
  std::vector<Ray<double>> rays(count);
  setting.rays(seed, first, rays);
  return rays;
}

inline std::vector<Vec3d> vertices_of(const Scene& scene) {
  std::vector<Vec3d> vertices;
  for (const auto& [a, b, c] : scene.triangles) vertices.insert(vertices.end(), {a, b, c});
  return vertices;
}

}  // namespace rayshoot
