#include "accel/parts/kd_build.h"

#include <algorithm>
#include <cmath>

#include "accel/parts/clipped_bounds.h"

namespace rayshoot {

template <class Real>
void add_events(BoundsEvents<Real>& events, const Box<Real>& bounds, std::uint32_t object) {
  using Event = BoundsEvent<Real>;
  for (int axis = 0; axis < 3; ++axis) {
    if (bounds.lo[axis] == bounds.hi[axis]) {
      events[axis].push_back({bounds.lo[axis], object, Event::flat});
    } else {
      events[axis].push_back({bounds.lo[axis], object, Event::begin});
      events[axis].push_back({bounds.hi[axis], object, Event::end});
    }
  }
}

template <class Real>
KdSplit<Real> best_plane(const Box<Real>& cell, std::size_t objects, const BoundsEvents<Real>& events,
                         const KdRules& rules) {
  KdSplit<Real> best;
  const double whole = cell.surface_area();
  for (int axis = 0; axis < 3; ++axis) {
    // The surface of a child is two caps and a mantle that grows with its length.
    const Vec3d extent(cell.extent());
    const double width = extent[(axis + 1) % 3], height = extent[(axis + 2) % 3];
    const double caps = 2 * width * height, mantle = 2 * (width + height);
    std::size_t lower = 0, upper = objects;
    for (std::size_t i = 0; i < events[axis].size();) {
      // Sweep the plane to the next position, and count what ends, lies and begins there.
      const Real plane = events[axis][i].position;
      std::size_t counts[3] = {};
      for (; i < events[axis].size() && events[axis][i].position == plane; ++i)
        ++counts[events[axis][i].kind];
      const auto [ends, flat, begins] = counts;
      upper -= ends + flat;
      if (cell.lo[axis] < plane && plane < cell.hi[axis]) {
        const double to_lower = (caps + mantle * (double{plane} - cell.lo[axis])) / whole;
        const double to_upper = (caps + mantle * (double{cell.hi[axis]} - plane)) / whole;
        for (const bool flat_to_lower : {true, false}) {
          const std::size_t in_lower = lower + (flat_to_lower ? flat : 0);
          const std::size_t in_upper = upper + (flat_to_lower ? 0 : flat);
          const double tests =
              to_lower * static_cast<double>(in_lower) + to_upper * static_cast<double>(in_upper);
          const double bonus = in_lower == 0 || in_upper == 0 ? 1 - rules.empty_bonus : 1;
          const double cost = bonus * (rules.traversal_cost + rules.intersection_cost * tests);
          if (cost < best.cost) best = {axis, plane, flat_to_lower, cost};
          if (flat == 0) break;
        }
      }
      lower += begins + flat;
    }
  }
  return best;
}

namespace {

template <class Real>
class KdBuilder {
 public:
  KdBuilder(const Geometry<Real>& geometry, const KdRules& rules, Real margin)
      : geometry_(geometry), rules_(rules), margin_(margin), sides_(geometry.size()) {
    const double levels = 8 + 1.3 * std::log2(std::max(1u, geometry.size()));
    max_depth_ = std::min(rules.max_depth ? rules.max_depth : static_cast<int>(levels), kMaxAxisTreeDepth);
  }

  AxisTree<Real> build() && {
    tree_.box = geometry_.bounds();
    if (geometry_.size() == 0) return {};
    BoundsEvents<Real> events;
    for (std::uint32_t object = 0; object < geometry_.size(); ++object)
      add_events(events, geometry_.bounds(object), object);
    for (auto& along_axis : events) std::sort(along_axis.begin(), along_axis.end());
    divide(tree_.box, geometry_.size(), std::move(events), 0);
    return std::move(tree_);
  }

 private:
  using Event = BoundsEvent<Real>;
  using Node = typename AxisTree<Real>::Node;
  enum Side : std::uint8_t { both, lower, upper };

  void divide(const Box<Real>& cell, std::size_t objects, BoundsEvents<Real> events, int depth) {
    // Keep the cell whole where equation (3) expects no gain.
    const KdSplit<Real> split =
        depth < max_depth_ ? best_plane(cell, objects, events, rules_) : KdSplit<Real>{};
    if (!split.found() || !(split.cost < rules_.intersection_cost * static_cast<double>(objects)))
      return add_leaf(events);

    // Say on which side of the plane each object lies, and hand its events down.
    classify(events, split);
    Box<Real> lower_cell = cell, upper_cell = cell;
    lower_cell.hi[split.axis] = upper_cell.lo[split.axis] = split.plane;
    BoundsEvents<Real> below, above;
    const auto [in_lower, in_upper] = hand_down(events, split.axis, lower_cell, upper_cell, below, above);
    events = {};

    const std::size_t node = tree_.nodes.size();
    tree_.nodes.push_back(Node::interior(split.axis, split.plane));
    divide(lower_cell, in_lower, std::move(below), depth + 1);
    tree_.nodes[node].link_upper(static_cast<std::uint32_t>(tree_.nodes.size() - node));
    divide(upper_cell, in_upper, std::move(above), depth + 1);
  }

  void add_leaf(const BoundsEvents<Real>& events) {
    const std::size_t first = tree_.references.size();
    for (const Event& event : events[0])
      if (event.kind != Event::end) tree_.references.push_back(event.object);
    std::sort(tree_.references.begin() + static_cast<std::ptrdiff_t>(first), tree_.references.end());
    tree_.nodes.push_back(Node::leaf(static_cast<std::uint32_t>(first),
                                     static_cast<std::uint32_t>(tree_.references.size() - first)));
  }

  void classify(const BoundsEvents<Real>& events, const KdSplit<Real>& split) {
    for (const Event& event : events[split.axis]) sides_[event.object] = both;
    for (const Event& event : events[split.axis]) {
      const bool at_plane = event.position == split.plane;
      if (event.kind == Event::end && event.position <= split.plane)
        sides_[event.object] = lower;
      else if (event.kind == Event::begin && event.position >= split.plane)
        sides_[event.object] = upper;
      else if (event.kind == Event::flat)
        sides_[event.object] =
            event.position < split.plane || (at_plane && split.flat_to_lower) ? lower : upper;
    }
  }

  /// Copy events to the children, which keeps them sorted; returns the numbers of objects there.
  std::pair<std::size_t, std::size_t> hand_down(const BoundsEvents<Real>& events, int split_axis,
                                                const Box<Real>& lower_cell, const Box<Real>& upper_cell,
                                                BoundsEvents<Real>& below, BoundsEvents<Real>& above) {
    std::size_t in_lower = 0, in_upper = 0;
    std::vector<std::uint32_t> divided;
    for (int axis = 0; axis < 3; ++axis)
      for (const Event& event : events[axis]) {
        const Side side = sides_[event.object];
        const bool counts = axis == split_axis && event.kind != Event::end;
        if (rules_.clipped && side == both) {
          if (counts) divided.push_back(event.object);
          continue;
        }
        if (side != upper) below[axis].push_back(event), in_lower += counts;
        if (side != lower) above[axis].push_back(event), in_upper += counts;
      }
    if (!divided.empty()) {
      in_lower += add_clipped(divided, lower_cell, below);
      in_upper += add_clipped(divided, upper_cell, above);
    }
    return {in_lower, in_upper};
  }

  /// Add the objects' bounds within a cell to its sorted events; returns how many have a part there.
  std::size_t add_clipped(const std::vector<std::uint32_t>& objects, const Box<Real>& cell,
                          BoundsEvents<Real>& events) const {
    std::size_t added = 0;
    BoundsEvents<Real> further;
    for (const std::uint32_t object : objects) {
      const Box<Real> part = clipped_bounds(geometry_, object, cell, margin_);
      if (part.empty()) continue;
      add_events(further, part, object);
      ++added;
    }
    for (int axis = 0; axis < 3; ++axis) {
      std::sort(further[axis].begin(), further[axis].end());
      const auto middle = static_cast<std::ptrdiff_t>(events[axis].size());
      events[axis].insert(events[axis].end(), further[axis].begin(), further[axis].end());
      std::inplace_merge(events[axis].begin(), events[axis].begin() + middle, events[axis].end());
    }
    return added;
  }

  const Geometry<Real>& geometry_;
  const KdRules& rules_;
  Real margin_;
  int max_depth_;
  AxisTree<Real> tree_;
  /// Of the objects of the cell that is being divided.
  std::vector<Side> sides_;
};

}  // namespace

template <class Real>
AxisTree<Real> build_kd_tree(const Geometry<Real>& geometry, const KdRules& rules, Real margin) {
  return KdBuilder<Real>(geometry, rules, margin).build();
}

template void add_events(BoundsEvents<float>&, const Box<float>&, std::uint32_t);
template void add_events(BoundsEvents<double>&, const Box<double>&, std::uint32_t);
template KdSplit<float> best_plane(const Box<float>&, std::size_t, const BoundsEvents<float>&,
                                   const KdRules&);
template KdSplit<double> best_plane(const Box<double>&, std::size_t, const BoundsEvents<double>&,
                                    const KdRules&);
template AxisTree<float> build_kd_tree(const Geometry<float>&, const KdRules&, float);
template AxisTree<double> build_kd_tree(const Geometry<double>&, const KdRules&, double);

}  // namespace rayshoot
