#pragma once

#include <istream>
#include <ostream>
#include <string>

#include "scenes/core/scene.h"

namespace rayshoot {

/// Digits with which every double reads back to itself.
inline constexpr int kFullPrecision = 17;

/// The scene in a file of the Neutral File Format (Haines 1987): records `b v l f p pp s c` and `#` comments.
/// Throws InputError "file:line: reason" on anything else, on numbers that are not finite, on polygons of
/// fewer than 3 vertices, on negative radii, and on objects before the view or before a material.
Scene read_nff(const std::string& path);
/// The same from a stream; `name` stands for it in messages.
Scene read_nff(std::istream& in, const std::string& name);

/// Write a scene with `precision` (1 to 17) significant digits, as C's %g does. Written with
/// `kFullPrecision`, a scene whose objects are in the order of their materials, as all generated and all read
/// ones are, reads back to the same content. Throws InputError when the file cannot be written or the scene
/// holds a number that is not finite.
void write_nff(const Scene& scene, const std::string& path, int precision = 6);
void write_nff(const Scene& scene, std::ostream& out, int precision = 6);

}  // namespace rayshoot
