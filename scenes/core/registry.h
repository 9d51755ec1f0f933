#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "scenes/core/scene_builder.h"
#include "scenes/core/spec.h"

namespace rayshoot {

/// A procedural scene: one file under scenes/<family>/ defines one, as `scene_<file name>()`.
struct SceneGenerator {
  std::string id;
  std::string title;
  /// Where the scene comes from: paper or package.
  std::string source;
  int default_size = 1;
  /// Smallest size for which the scene is defined.
  int min_size = 1;
  /// What the scene exercises and how its number of objects depends on its size.
  std::string purpose;
  /// Further parameters beside size, form and tessellation.
  std::vector<Parameter> parameters;
  /// Number of objects in the given form, computed without generating: guards against sizes that cannot fit.
  double (*object_count)(const SceneOptions& options, const Arguments& arguments);
  /// How many of them are stored, where parts are placed more than once; all elsewhere.
  double (*stored_objects)(const SceneOptions& options, const Arguments& arguments) = nullptr;
  void (*generate)(const SceneOptions& options, const Arguments& arguments, SceneBuilder& builder);
};

/// All generators, sorted by id.
std::span<const SceneGenerator* const> scene_generators();

}  // namespace rayshoot
