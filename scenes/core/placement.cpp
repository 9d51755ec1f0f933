#include "scenes/core/placement.h"

#include <fmt/format.h>

#include <algorithm>

#include "scenes/core/scene.h"
#include "scenes/core/spec.h"

namespace rayshoot {

std::vector<const Scene*> distinct_parts(const Scene& scene) {
  std::unordered_set<const Scene*> known;
  std::vector<const Scene*> parts;
  append_parts(scene, known, parts);
  return parts;
}

bool has_motion(const Scene& scene) {
  const auto moves = [](const Scene& one) {
    return std::any_of(one.placements.begin(), one.placements.end(),
                       [](const Placement& p) { return p.moves(); });
  };
  const std::vector<const Scene*> parts = distinct_parts(scene);
  return moves(scene) ||
         std::any_of(parts.begin(), parts.end(), [&](const Scene* part) { return moves(*part); });
}

void require_nothing_placed(const Scene& scene, const std::string& what) {
  if (!scene.placements.empty())
    throw InputError(fmt::format("{}: no such file can say that parts are placed, as in {}", what, scene.id));
}

Vec3d ObjectInPart::normal_outside(const Vec3d& normal) const {
  // A normal maps by the transposed of what maps directions the other way.
  const Affine& inward = part_from_scene;
  return placed ? normalized(inward.x * normal.x + inward.y * normal.y + inward.z * normal.z) : normal;
}

ObjectInPart object_in_part(const Scene& scene, std::uint32_t number, const Vec3d& point, double time) {
  ObjectInPart found{&scene, number, point, {}};
  while (!found.scene->first_numbers.empty()) {
    // Find the object that holds the number.
    const std::vector<std::uint32_t>& first = found.scene->first_numbers;
    const auto behind = std::upper_bound(first.begin(), first.end(), found.object);
    const auto object = static_cast<std::uint32_t>(behind - first.begin() - 1);
    const SceneObject& entry = found.scene->objects[object];
    if (entry.kind != ObjectKind::placed) {
      found.object = object;
      return found;
    }
    // Go on in the part that it is.
    const Placement& placement = found.scene->placements[entry.index];
    const Affine inward = inverse(placement.scene_from_part);
    found = {placement.part.get(), found.object - first[object],
             inward(found.point - placement.velocity * time), compose(inward, found.part_from_scene), true};
  }
  return found;
}

}  // namespace rayshoot
