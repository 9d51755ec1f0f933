#pragma once

#include <optional>
#include <string>

#include "scenes/core/registry.h"
#include "scenes/core/scene.h"

namespace rayshoot {

/// A scene with what reports say of its origin. A scene from a file has neither generator, size nor form.
struct LoadedScene {
  Scene scene;
  std::string generator;
  std::optional<int> size;
  std::string form;
};

/// The scene that a specification names: `balls`, `balls:4`, `balls:4/patches`,
/// `balls(size=4,form=patches,tessellation=4)`, a generator's own parameters likewise in parentheses, or a
/// path that ends in .nff, .obj, .ply, .off or .stl. `tessellation` stands in for that parameter where a
/// specification in the form `patches` does not give it. The scene's id is the specification in its canonical
/// form, "balls:4/curves", with whatever differs from the defaults in parentheses,
/// "balls:4/patches(tessellation=4)"; for a file it is the path. Throws InputError, which says what is
/// accepted, on unknown names and values, on unreadable files, and on sizes that this machine's memory cannot
/// hold.
LoadedScene load_scene(const std::string& spec, std::optional<int> tessellation = {});

/// The id that `load_scene` would give, without loading: throws InputError where `load_scene` would, but for
/// the content of files.
std::string scene_id(const std::string& spec, std::optional<int> tessellation = {});

/// Throws InputError unless `objects` objects fit into a scene and, with what tracing compiles them to, into
/// `memory` bytes; `id` names the scene in the message.
void check_object_count(const std::string& id, double objects, double memory);

}  // namespace rayshoot
