#pragma once

#include <optional>

#include "accel/parts/huge_pages.h"
#include "accel/parts/sah_split.h"
#include "accel/parts/surface_margin.h"
#include "scenes/core/geometry.h"

namespace rayshoot {

/// Cut slivers before a hierarchy is built (M. Ernst & G. Greiner, "Early split clipping for bounding volume hierarchies",
/// 2007; how pieces are shared out follows T. Karras & T. Aila, "Fast parallel construction of high-quality bounding
/// volume hierarchies", 2013): a triangle or planar polygon whose box is mostly void is listed in several smaller
/// boxes that hold it together. At most `budget` boxes for each object are added to `objects`; none where slivers are
/// too few to matter.
/// Returns the margin that rays must keep from the boxes, where anything was cut: a hit on a piece may lie beside it by
/// as much as the ray's rounding. It is already in the boxes for ordinary rays.
template <class Real>
std::optional<SurfaceMargin<Real>> split_slivers(const Geometry<Real>& geometry, double budget,
                                                 HugeVector<BoxedObject<Real>>& objects);

}  // namespace rayshoot
