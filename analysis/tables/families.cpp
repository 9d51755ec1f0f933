#include "analysis/tables/families.h"

#include <fmt/format.h>

#include <algorithm>
#include <tuple>

#include "analysis/tables/comparison.h"

namespace rayshoot::analysis {

namespace {

/// "balls as patches", with arguments behind it where the scene has some besides its size.
std::string name_of(const report::Scene& scene) {
  const std::size_t arguments = scene.id.find('(');
  if (arguments == std::string::npos) return fmt::format("{} as {}", scene.generator, scene.form);
  return fmt::format("{} as {} {}", scene.generator, scene.form, scene.id.substr(arguments));
}

/// The family that a group alone would be.
Family family_of(const Group& group) {
  const std::string prefix = group.scene_id + "/";
  return {name_of(*group.scene),
          group.rays_id.starts_with(prefix) ? group.rays_id.substr(prefix.size()) : group.rays_id,
          precision_of(group),
          {{group.scene->objects, &group}}};
}

}  // namespace

std::vector<Family> families(const std::vector<Group>& groups) {
  std::vector<Family> result;
  for (const Group& group : groups) {
    if (!group.scene || !group.rays || group.entries.empty()) continue;
    Family family = family_of(group);
    const auto found = std::find_if(result.begin(), result.end(), [&](const Family& other) {
      return std::tie(other.scene, other.rays, other.precision) ==
             std::tie(family.scene, family.rays, family.precision);
    });
    if (found == result.end())
      result.push_back(std::move(family));
    else
      found->by_objects.merge(family.by_objects);
  }
  std::erase_if(result, [](const Family& family) { return family.by_objects.size() < kLeastSizes; });
  return result;
}

}  // namespace rayshoot::analysis
