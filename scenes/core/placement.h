#pragma once

#include <memory>
#include <string>
#include <unordered_set>
#include <vector>

#include "scenes/core/affine.h"

namespace rayshoot {

struct Scene;

/// A scene as a part of another one: where it stands there, and how it moves. Any number of placements share a part, so that
/// it is stored once (Snyder & Barr 1987).
struct Placement {
  std::shared_ptr<const Scene> part;
  /// From the part's coordinates to those of the scene around it, at the time 0.
  Affine scene_from_part;
  /// How far it moves, without turning, until the time 1. Rays carry times from 0 to 1 (Glassner 1988).
  Vec3d velocity{};

  bool moves() const { return velocity != Vec3d{}; }
};

/// Append the parts that are placed in a scene or what it was compiled to, at any depth: each once, however often it is
/// placed, and behind those that are placed in it.
template <class Whole>
void append_parts(const Whole& whole, std::unordered_set<const Whole*>& known,
                  std::vector<const Whole*>& parts) {
  for (const auto& placement : placements_of(whole)) {
    const Whole* part = placement.part.get();
    if (!known.insert(part).second) continue;
    append_parts(*part, known, parts);
    parts.push_back(part);
  }
}

/// All parts of a scene, in that order.
std::vector<const Scene*> distinct_parts(const Scene& scene);

/// Whether something in the scene, at any depth, moves.
bool has_motion(const Scene& scene);

/// Throws InputError where parts are placed: `what` has no way to say so.
void require_nothing_placed(const Scene& scene, const std::string& what);

/// An object of a scene at the depth at which it was modelled.
struct ObjectInPart {
  /// The part, or the scene itself, and the position of the object among its own.
  const Scene* scene;
  std::uint32_t object;
  /// A point of the whole scene, in the part's coordinates.
  Vec3d point;
  /// From directions of the whole scene to those of the part.
  Affine part_from_scene;
  /// Whether it is in a part: its coordinates are then others than the scene's.
  bool placed = false;

  /// A normal of the part as a unit vector of the whole scene.
  Vec3d normal_outside(const Vec3d& normal) const;
};

/// The object of that number (`Scene::numbers`), as seen from a point at a time.
ObjectInPart object_in_part(const Scene& scene, std::uint32_t number, const Vec3d& point = {},
                            double time = 0);

}  // namespace rayshoot
