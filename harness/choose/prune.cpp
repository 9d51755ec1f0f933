#include "harness/choose/prune.h"

#include <fmt/format.h>

namespace rayshoot {

namespace {

/// Searching all of so many objects can still be the fastest.
constexpr std::uint32_t kFewObjects = 64;
/// Where cells of one size hold more objects than this, dividing places of their own is worth it.
constexpr double kCrowded = 50;
/// Where they hold fewer, one structure has divided enough.
constexpr double kEven = 4;
/// A technique that was never nearer to the fastest than this is not expected to win elsewhere.
constexpr double kHopeless = 1.5;

std::string tests_everything(const TechniqueInfo& technique, const SceneStatistics& scene) {
  if (technique.max_practical_objects == UINT64_MAX || scene.objects <= kFewObjects) return {};
  return fmt::format("it tests every ray with each of {} objects; up to {} that can be worth it",
                     scene.objects, kFewObjects);
}

std::string too_crowded(const TechniqueInfo& technique, const SceneStatistics& scene) {
  if (technique.id != "uniform_grid" || scene.crowding <= kCrowded) return {};
  return fmt::format("its cells are of one size, and the average object would be one of {:.0f} in its cell",
                     scene.crowding);
}

std::string evenly_spread(const TechniqueInfo& technique, const SceneStatistics& scene) {
  if (technique.family != "algebra" && technique.family != "composed") return {};
  if (scene.crowding >= kEven) return {};
  return fmt::format(
      "objects are spread evenly, {:.1f} to a cell of a grid: a second structure has nothing to divide",
      scene.crowding);
}

std::string known_record(const TechniqueInfo& technique, const Constants& constants) {
  const TechniqueConstants* known = constants.find(technique.id);
  if (!known) return "no constants were fitted for it";
  if (known->at_least < kHopeless) return {};
  return fmt::format(
      "it took {:.2g} times as long as the fastest or longer on all {} cells that were measured",
      known->at_least, constants.cells);
}

}  // namespace

std::string why_not_weighed(const TechniqueChoice& candidate, const SceneStatistics& scene,
                            const Constants& constants) {
  const TechniqueInfo& technique = candidate.entry->info;
  for (const std::string& why : {tests_everything(technique, scene), too_crowded(technique, scene),
                                 evenly_spread(technique, scene), known_record(technique, constants)})
    if (!why.empty()) return why;
  return {};
}

}  // namespace rayshoot
