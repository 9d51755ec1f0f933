#include "accel/parts/object_hierarchy.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <span>

namespace rayshoot {

namespace {

/// Clusters that a set of objects or groups is divided into at the most.
constexpr std::size_t kMostClusters = 8;
/// Groups that stand below one node at the most.
constexpr std::size_t kMostGroups = 16;
/// So deep no histogram goes: what it has not told apart is halved.
constexpr int kMostHistograms = 48;

/// An object or a group with its centre.
struct Item {
  Vec3d centre;
  std::uint32_t number;
};

/// A 3-D histogram of centres, with cells that are cubes.
class Histogram {
 public:
  using Cell = std::array<int, 3>;

  Histogram(std::span<const Item> items, int resolution) {
    Box<double> box;
    for (const Item& item : items) box.include(item.centre);
    lo_ = box.lo;
    const Vec3d extent = box.extent();
    const double longest = max_abs(extent);
    scale_ = resolution / longest;
    if (!tells_apart()) return;
    for (int axis = 0; axis < 3; ++axis)
      cells_[axis] = std::clamp(static_cast<int>(std::ceil(extent[axis] * scale_)), 1, resolution);
    counts_.resize(static_cast<std::size_t>(cells_[0]) * cells_[1] * cells_[2]);
    for (const Item& item : items) ++counts_[number(cell(item))];
  }

  /// Whether the centres extend far enough to be told apart.
  bool tells_apart() const { return std::isfinite(scale_) && scale_ > 0; }

  /// A centre in units of cells.
  Vec3d position(const Item& item) const { return (item.centre - lo_) * scale_; }
  Cell cell(const Item& item) const {
    const Vec3d at = position(item);
    Cell cell;
    for (int axis = 0; axis < 3; ++axis) cell[axis] = std::min(static_cast<int>(at[axis]), cells_[axis] - 1);
    return cell;
  }

  /// The densest cells of which none is the neighbour of a denser one chosen before, densest first.
  std::vector<Cell> peaks() const {
    std::vector<std::uint32_t> occupied;
    for (std::uint32_t c = 0; c < counts_.size(); ++c)
      if (counts_[c] > 0) occupied.push_back(c);
    std::stable_sort(occupied.begin(), occupied.end(),
                     [&](auto a, auto b) { return counts_[a] > counts_[b]; });
    std::vector<Cell> peaks;
    for (std::size_t i = 0; i < occupied.size() && peaks.size() < kMostClusters; ++i) {
      const Cell candidate = cell_numbered(occupied[i]);
      const auto is_neighbour = [&](const Cell& peak) {
        return std::abs(peak[0] - candidate[0]) <= 1 && std::abs(peak[1] - candidate[1]) <= 1 &&
               std::abs(peak[2] - candidate[2]) <= 1;
      };
      if (std::none_of(peaks.begin(), peaks.end(), is_neighbour)) peaks.push_back(candidate);
    }
    return peaks;
  }

 private:
  std::size_t number(const Cell& cell) const {
    return (static_cast<std::size_t>(cell[2]) * cells_[1] + cell[1]) * cells_[0] + cell[0];
  }
  Cell cell_numbered(std::uint32_t number) const {
    const auto x = static_cast<std::uint32_t>(cells_[0]), y = static_cast<std::uint32_t>(cells_[1]);
    return {static_cast<int>(number % x), static_cast<int>(number / x % y), static_cast<int>(number / x / y)};
  }

  Vec3d lo_;
  double scale_ = 0;
  std::array<int, 3> cells_{};
  std::vector<std::uint32_t> counts_;
};

/// Cut items in two, in the order in which they stand.
std::vector<std::span<Item>> halves(std::span<Item> items) {
  return {items.subspan(0, items.size() / 2), items.subspan(items.size() / 2)};
}

/// Cut items in two at the median of their centres along the axis of that depth.
std::vector<std::span<Item>> median_halves(std::span<Item> items, int depth) {
  std::stable_sort(items.begin(), items.end(), [axis = depth % 3](const Item& a, const Item& b) {
    return a.centre[axis] < b.centre[axis];
  });
  return halves(items);
}

/// Divide items among the densest peaks of their histogram, each to the nearest; two clusters at least, none empty.
std::vector<std::span<Item>> clusters(std::span<Item> items, int resolution, int depth) {
  // A histogram of about a cell an item tells enough; of three cells the outer ones are no neighbours.
  const int useful = std::max(3, static_cast<int>(std::cbrt(2.0 * static_cast<double>(items.size()))));
  const Histogram histogram(items, std::min(resolution, useful));
  if (!histogram.tells_apart() || depth > kMostHistograms) return halves(items);

  // Find the peak nearest to each item.
  const std::vector<Histogram::Cell> peaks = histogram.peaks();
  const auto nearest_peak = [&](const Item& item) {
    const Vec3d at = histogram.position(item);
    std::size_t nearest = 0;
    double least = Box<double>::infinity();
    for (std::size_t k = 0; k < peaks.size(); ++k) {
      const Vec3d offset = at - Vec3d{peaks[k][0] + 0.5, peaks[k][1] + 0.5, peaks[k][2] + 0.5};
      if (dot(offset, offset) < least) nearest = k, least = dot(offset, offset);
    }
    return nearest;
  };
  std::vector<std::vector<Item>> members(peaks.size());
  for (const Item& item : items) members[nearest_peak(item)].push_back(item);

  // Put them back cluster by cluster.
  std::vector<std::span<Item>> clusters;
  std::size_t first = 0;
  for (const std::vector<Item>& cluster : members) {
    if (cluster.empty()) continue;
    std::copy(cluster.begin(), cluster.end(), items.begin() + static_cast<std::ptrdiff_t>(first));
    clusters.push_back(items.subspan(first, cluster.size()));
    first += cluster.size();
  }
  return clusters.size() > 1 ? clusters : halves(items);
}

template <class Real>
class HierarchyBuilder {
 public:
  HierarchyBuilder(const Geometry<Real>& geometry, const HierarchyConfig& config)
      : geometry_(geometry), groups_(geometry.groups()), config_(config) {
    hierarchy_.order.reserve(geometry.size());
  }

  ObjectHierarchy build() && {
    if (geometry_.size() == 0) return {};
    if (config_.source == HierarchySource::modeller && !groups_.empty()) {
      add_group(0);
    } else {
      std::vector<Item> objects;
      append_objects(0, geometry_.size(), objects);
      add_node(objects, {}, false, 0);
    }
    return std::move(hierarchy_);
  }

 private:
  Item item(std::uint32_t number, const Box<Real>& box) const {
    return {Box<double>{Vec3d(box.lo), Vec3d(box.hi)}.centre(), number};
  }

  void append_objects(std::uint32_t first, std::uint32_t last, std::vector<Item>& items) const {
    for (std::uint32_t object = first; object < last; ++object)
      items.push_back(item(object, geometry_.bounds(object)));
  }

  Item group_item(std::uint32_t group) const {
    Box<Real> box;
    for (std::uint32_t object = groups_[group].first; object < groups_[group].last; ++object)
      box.include(geometry_.bounds(object));
    return item(group, box);
  }

  /// A node for a group of the modeller's: its objects that are in no smaller group, and the groups in it.
  void add_group(std::uint32_t group) {
    std::vector<Item> objects, groups;
    std::uint32_t object = groups_[group].first;
    for (std::uint32_t nested = group + 1; nested < groups_[group].end; nested = groups_[nested].end) {
      append_objects(object, groups_[nested].first, objects);
      object = groups_[nested].last;
      if (groups_[nested].size() > 0) groups.push_back(group_item(nested));
    }
    append_objects(object, groups_[group].last, objects);
    add_node(objects, groups, true, 0);
  }

  /// A node for some objects and groups, which are clustered where they are too many. `depth` counts the nodes about it
  /// since the last group.
  void add_node(std::span<Item> objects, std::span<Item> groups, bool modelled, int depth) {
    const std::size_t node = hierarchy_.nodes.size();
    const auto here = [this] { return static_cast<std::uint32_t>(hierarchy_.order.size()); };
    hierarchy_.nodes.push_back({.first = here(), .own_last = 0, .last = 0, .end = 0, .modelled = modelled});
    const bool holds_objects = objects.size() <= config_.max_objects;
    if (holds_objects)
      for (const Item& object : objects) hierarchy_.order.push_back(object.number);
    hierarchy_.nodes[node].own_last = here();
    if (!holds_objects)
      for (const std::span<Item> part : divided(objects, depth)) add_node(part, {}, false, depth + 1);
    add_groups(groups, depth);
    hierarchy_.nodes[node].last = here();
    hierarchy_.nodes[node].end = static_cast<std::uint32_t>(hierarchy_.nodes.size());
  }

  std::vector<std::span<Item>> divided(std::span<Item> items, int depth) const {
    return config_.source == HierarchySource::median ? median_halves(items, depth)
                                                     : clusters(items, config_.resolution, depth);
  }

  void add_groups(std::span<Item> groups, int depth) {
    if (groups.size() <= kMostGroups) {
      for (const Item& group : groups) add_group(group.number);
      return;
    }
    for (const std::span<Item> cluster : divided(groups, depth))
      if (cluster.size() == 1)
        add_group(cluster.front().number);
      else
        add_node({}, cluster, false, depth + 1);
  }

  const Geometry<Real>& geometry_;
  std::span<const Group> groups_;
  HierarchyConfig config_;
  ObjectHierarchy hierarchy_;
};

}  // namespace

std::vector<Parameter> hierarchy_parameters(const HierarchyConfig& by_default) {
  return {
      choice_parameter(
          "hierarchy", kHierarchySourceNames[static_cast<std::size_t>(by_default.source)],
          {kHierarchySourceNames.begin(), kHierarchySourceNames.end()},
          "the modeller's grouping, where the scene states one, automatic clustering, or halves"),
      integer_parameter("resolution", kHistogramCells, 3, 64,
                        "cells of the clustering histogram along the longest axis"),
      integer_parameter("max_objects", by_default.max_objects, 1, 64, "objects that a node may hold itself")};
}

HierarchyConfig hierarchy_config(const Arguments& arguments) {
  const std::string& source = arguments.text("hierarchy");
  const auto named = std::find(kHierarchySourceNames.begin(), kHierarchySourceNames.end(), source);
  const HierarchyConfig config{.source = static_cast<HierarchySource>(named - kHierarchySourceNames.begin()),
                               .resolution = static_cast<int>(arguments.integer("resolution")),
                               .max_objects = static_cast<std::uint32_t>(arguments.integer("max_objects"))};
  if (config.source == HierarchySource::median && config.resolution != kHistogramCells)
    throw InputError("hierarchy=median makes no histogram; with it leave resolution at " +
                     std::to_string(kHistogramCells));
  return config;
}

template <class Real>
ObjectHierarchy object_hierarchy(const Geometry<Real>& geometry, const HierarchyConfig& config) {
  return HierarchyBuilder<Real>(geometry, config).build();
}

template ObjectHierarchy object_hierarchy(const Geometry<float>&, const HierarchyConfig&);
template ObjectHierarchy object_hierarchy(const Geometry<double>&, const HierarchyConfig&);

}  // namespace rayshoot
