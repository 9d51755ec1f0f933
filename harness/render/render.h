#pragma once

#include <string>

#include "accel/core/engine.h"
#include "harness/render/image.h"

namespace rayshoot {

/// What a picture shows: the scene, or what eye rays cost, pixel by pixel.
enum class Show { shaded, tests, steps };

/// The value that a word of the command line names; throws InputError on others.
Show show_named(const std::string& word);

struct RenderOptions {
  Show show = Show::shaded;
  /// Size in pixels; 0 for that which the scene's view asks for.
  int width = 0, height = 0;
  int threads = 1;
  /// Rows and columns of rays in a pixel of a shaded picture.
  int samples = 2;
};

/// Trace a picture of a scene with a technique. Shaded pictures are traced in double precision, heat maps of
/// work in float where the technique has it. Throws InputError on a size that is not a picture's, and for a
/// technique that cannot show what is asked for.
Image render(const Scene& scene, const TechniqueEntry& technique, const Arguments& arguments,
             const RenderOptions& asked);

}  // namespace rayshoot
