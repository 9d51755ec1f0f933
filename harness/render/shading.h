#pragma once

#include "harness/render/image.h"
#include "scenes/rays/distribution.h"

namespace rayshoot {

/// A Whitted-style picture (1980) with the materials of NFF: Phong's local light with shadows, mirrors and
/// glass five generations deep, and a little ambient light. Each pixel averages samples x samples rays.
/// Lights without a colour have an intensity of 1 / sqrt(number of lights) each, as NFF asks, so that scenes
/// with many lights stay within range. Colours of a scene are those of a screen (sRGB): light is computed
/// from what they stand for. The tracer is called from all threads at once.
Image shaded_picture(const Scene& scene, const Tracer& tracer, int width, int height, int samples,
                     int threads);

}  // namespace rayshoot
