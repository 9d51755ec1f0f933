#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "scenes/core/geometry.h"
#include "scenes/core/spec.h"

namespace rayshoot {

/// Where a hierarchy of objects comes from: the modeller's own grouping, automatic clustering (Rubin & Whitted 1980), or
/// halves of the objects in the order of their centres along x, y and z in turn (Kay & Kajiya 1986).
enum class HierarchySource { modeller, automatic, median };
inline constexpr std::array kHierarchySourceNames = {"modeller", "automatic", "median"};

/// Cells of a clustering histogram along its longest axis, where nothing else is said.
inline constexpr int kHistogramCells = 8;

struct HierarchyConfig {
  HierarchySource source = HierarchySource::modeller;
  /// Cells of the histogram along the longest axis.
  int resolution = kHistogramCells;
  /// Objects that a node may hold itself.
  std::uint32_t max_objects = 4;
};

/// The parameters `hierarchy`, `resolution` and `max_objects` with the defaults `by_default`, and their values. Throws
/// InputError for a resolution where no histogram is made.
std::vector<Parameter> hierarchy_parameters(const HierarchyConfig& by_default = {});
HierarchyConfig hierarchy_config(const Arguments& arguments);

/// A hierarchy of objects before anybody bounds it. Nodes stand depth first; a node's objects are consecutive, its own
/// before those of the nodes below it.
struct ObjectHierarchy {
  struct Node {
    std::uint32_t first, own_last, last;  ///< positions in `order`: own objects end at own_last, all at last
    std::uint32_t end;                    ///< the nodes below are those up to here
    bool modelled;                        ///< a group of the modeller's
  };
  std::vector<Node> nodes;
  /// Every object once.
  std::vector<std::uint32_t> order;
};

/// The modeller's hierarchy where it is asked for and the geometry has one; the one of halves where that is asked for;
/// otherwise that of the densest peaks of a 3-D histogram: the objects whose centres lie nearest to a peak form a cluster, and so on with
/// every cluster. What is too much for one node of the modeller's is divided in the same way.
template <class Real>
ObjectHierarchy object_hierarchy(const Geometry<Real>& geometry, const HierarchyConfig& config);

}  // namespace rayshoot
