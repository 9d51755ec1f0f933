#include "accel/parts/octree_build.h"

#include <algorithm>
#include <bit>
#include <numeric>

#include "accel/parts/for_each_below.h"
#include "accel/parts/surface_margin.h"

namespace rayshoot {

std::vector<Parameter> octree_parameters() {
  return {
      integer_parameter(
          "max_depth", 0, 0, kMaxOctreeDepth,
          "divisions between the root and the smallest cell; 0: suited to the number of objects"),
      integer_parameter("max_objects", OctreeLimits{}.max_objects, 1, 1'000'000,
                        "a cell with that many objects or fewer is not divided"),
      choice_parameter("assignment", "surface", {"surface", "box"},
                       "a leaf refers to the objects whose surface penetrates it, or whose bounds touch it"),
      choice_parameter("split", "centre", {"centre", "cost"},
                       "where a cell is divided: in its middle, or where surfaces times objects are least"),
      boolean_parameter("separating", true,
                        "a cell that two divisions in a row would not separate is a leaf at once")};
}

OctreeLimits octree_limits(const Arguments& arguments) {
  return octree_limits(arguments,
                       arguments.text("assignment") == "box" ? Assignment::box : Assignment::surface);
}

OctreeLimits octree_limits(const Arguments& arguments, Assignment assignment) {
  return {.max_depth = static_cast<int>(arguments.integer("max_depth")),
          .max_objects = static_cast<std::uint32_t>(arguments.integer("max_objects")),
          .assignment = assignment,
          .split = arguments.text("split") == "cost" ? OctreeSplit::cost : OctreeSplit::centre,
          .separating = arguments.boolean("separating")};
}

int suitable_depth(std::uint32_t objects) {
  // A surface passes 4^depth cells.
  return std::min(static_cast<int>(std::bit_width(objects) + 1) / 2 + 2, kMaxOctreeDepth);
}

namespace {

/// A cell of the level under construction, its objects, and after sorting what its children get.
struct OpenCell {
  std::uint32_t node = 0;
  LatticeCell cell{};
  /// The planes that divide it.
  Layers planes{};
  std::uint64_t first = 0;
  std::uint32_t count = 0;
  std::array<std::uint32_t, 8> child_counts{};
  /// Whether the division that made the cell separated anything.
  bool separated = true;

  /// Whether division will separate anything.
  bool separable() const {
    return std::any_of(child_counts.begin(), child_counts.end(), [&](std::uint32_t n) { return n < count; });
  }
  std::uint64_t children() const {
    return std::accumulate(child_counts.begin(), child_counts.end(), std::uint64_t{0});
  }
};

template <class Real>
class OctreeBuilder {
 public:
  OctreeBuilder(const Geometry<Real>& geometry, const OctreeLimits& limits)
      : geometry_(geometry),
        limits_(limits),
        max_references_(std::min<std::uint64_t>(
            kSpareReferences + limits.references_per_object * geometry.size(), UINT32_MAX - 1)) {
    if (limits.assignment == Assignment::surface) margin_ = SurfaceMargin<Real>(geometry.bounds()).of_cells();
    // Cells not much thicker than the margin would all get the same objects.
    max_depth_ = limits.max_depth ? limits.max_depth : suitable_depth(geometry.size());
    octree_.lattice =
        Lattice<Real>::over(geometry.bounds(), by_cost() ? kMaxOctreeDepth : max_depth_, 4 * margin_);
    max_depth_ = std::min(max_depth_, octree_.lattice.depth);
  }

  Octree<Real> build() && {
    // Begin with one cell that holds everything.
    octree_.nodes.resize(1);
    objects_.resize(geometry_.size());
    std::iota(objects_.begin(), objects_.end(), 0u);
    cells_.push_back({.cell = octree_.lattice.whole(), .count = geometry_.size()});

    // Level by level, divide every cell with too many objects, if that separates them and storage allows.
    int& depth = octree_.depth;
    for (;; ++depth) {
      close_cells([&](const OpenCell& cell) {
        const auto& [x, y, z] = cell.cell.size;
        return cell.count <= limits_.max_objects || std::min({x, y, z}) < 2;
      });
      if (depth == max_depth_) break;
      sort_into_children();
      if (limits_.separating)
        close_cells([](const OpenCell& cell) { return !cell.separable() && !cell.separated; });
      if (cells_.empty() || !storage_suffices()) break;
      divide();
    }
    close_cells([](const OpenCell&) { return true; });
    if (!by_cost()) octree_.lattice = octree_.lattice.coarsened(depth);
    return std::move(octree_);
  }

 private:
  /// Make leaves of the open cells for which `done` holds.
  template <class Predicate>
  void close_cells(const Predicate& done) {
    std::erase_if(cells_, [&](const OpenCell& cell) {
      if (!done(cell)) return false;
      octree_.nodes[cell.node] = {static_cast<std::uint32_t>(octree_.references.size()), cell.count};
      record(cell);
      const auto begin = objects_.begin() + static_cast<std::ptrdiff_t>(cell.first);
      octree_.references.insert(octree_.references.end(), begin, begin + cell.count);
      return true;
    });
  }

  bool by_cost() const { return limits_.split == OctreeSplit::cost; }

  /// Keep where a node is, unless that follows from where it stands in the tree.
  void record(const OpenCell& cell) {
    if (!by_cost()) return;
    octree_.places.resize(octree_.nodes.size());
    octree_.places[cell.node] = {cell.cell, cell.planes};
  }

  /// Choose the plane on an axis among some from the middle of a cell to the median of the objects' centres. Each part has
  /// a surface, and the objects that touch it; the sum of their products is to be least.
  int cheapest_plane(const OpenCell& cell, int axis) const {
    constexpr int kPlanes = 10;
    std::vector<Real> lo, hi, centres;
    for (std::uint32_t k = 0; k < cell.count; ++k) {
      const Box<Real> bounds = geometry_.bounds(objects_[cell.first + k]);
      lo.push_back(bounds.lo[axis]), hi.push_back(bounds.hi[axis]);
      centres.push_back(bounds.centre()[axis]);
    }
    std::nth_element(centres.begin(), centres.begin() + cell.count / 2, centres.end());
    const int begin = cell.cell.corner[axis], end = cell.cell.end(axis), middle = begin + (end - begin) / 2;
    const Real layers_below =
        (centres[cell.count / 2] - octree_.lattice.lo[axis]) / octree_.lattice.step[axis];
    const int median = static_cast<int>(
        std::clamp<Real>(std::round(layers_below), static_cast<Real>(begin + 1), static_cast<Real>(end - 1)));

    const Vec3d extent(octree_.lattice.cell(cell.cell).extent());
    const double b = extent[(axis + 1) % 3], c = extent[(axis + 2) % 3];
    int best = middle;
    double least = Box<double>::infinity();
    for (int i = 0; i < kPlanes; ++i) {
      const int plane = middle + static_cast<int>(std::lround((median - middle) * (i / (kPlanes - 1.0))));
      const Real at = octree_.lattice.plane(axis, plane);
      const auto below =
          std::count_if(lo.begin(), lo.end(), [&](Real begins) { return begins <= at + margin_; });
      const auto above = std::count_if(hi.begin(), hi.end(), [&](Real ends) { return ends >= at - margin_; });
      const double t = extent[axis] * (plane - begin) / (end - begin);
      const double cost = static_cast<double>(below) * (2 * t * (b + c) + b * c) +
                          static_cast<double>(above) * (2 * (extent[axis] - t) * (b + c) + b * c);
      if (cost < least) best = plane, least = cost;
    }
    return best;
  }

  void choose_planes(OpenCell& cell) const {
    cell.planes = cell.cell.centre();
    if (by_cost())
      for (int axis = 0; axis < 3; ++axis) cell.planes[axis] = cheapest_plane(cell, axis);
  }

  void sort_into_children() {
    octants_.resize(objects_.size());
    for_each_below(cells_.size(), [&](std::size_t i) {
      OpenCell& cell = cells_[i];
      choose_planes(cell);
      for_each_below(cell.count, [&](std::size_t k) {
        octants_[cell.first + k] = octants_of(objects_[cell.first + k], cell);
      });
      for (std::uint32_t k = 0; k < cell.count; ++k)
        for (int octant = 0; octant < 8; ++octant)
          cell.child_counts[octant] += octants_[cell.first + k] >> octant & 1;
    });
  }

  /// The children of a cell to which one of its objects belongs: bit i for octant i.
  std::uint8_t octants_of(std::uint32_t object, const OpenCell& cell) const {
    constexpr unsigned lower_halves[] = {0b01010101, 0b00110011, 0b00001111};
    const Box<Real> bounds = geometry_.bounds(object);
    unsigned octants = 0xFF;
    for (int axis = 0; axis < 3; ++axis) {
      const Real plane = octree_.lattice.plane(axis, cell.planes[axis]);
      if (!(bounds.lo[axis] <= plane + margin_)) octants &= ~lower_halves[axis];
      if (!(bounds.hi[axis] >= plane - margin_)) octants &= lower_halves[axis];
    }
    // What lies in one child by its bounds lies there with the part of its surface that is in this cell.
    if (limits_.assignment == Assignment::surface && !std::has_single_bit(octants))
      for (unsigned octant = 0; octant < 8; ++octant)
        if ((octants >> octant & 1) && !penetrates(object, cell.cell.child(octant, cell.planes)))
          octants &= ~(1u << octant);
    return static_cast<std::uint8_t>(octants);
  }

  bool penetrates(std::uint32_t object, const LatticeCell& cell) const {
    return geometry_.overlaps(object, widened(octree_.lattice.cell(cell), margin_));
  }

  bool storage_suffices() const {
    std::uint64_t references = octree_.references.size();
    for (const OpenCell& cell : cells_) references += cell.children();
    return references <= max_references_ && octree_.nodes.size() + 8 * cells_.size() < UINT32_MAX;
  }

  /// Replace the open cells by their children.
  void divide() {
    std::vector<OpenCell> children;
    children.reserve(8 * cells_.size());
    std::uint64_t first = 0;
    for (const OpenCell& cell : cells_) {
      octree_.nodes[cell.node] = {static_cast<std::uint32_t>(octree_.nodes.size() + children.size()),
                                  Octree<Real>::Node::kInterior};
      record(cell);
      for (unsigned octant = 0; octant < 8; ++octant) {
        const auto node = static_cast<std::uint32_t>(octree_.nodes.size() + children.size());
        children.push_back({.node = node,
                            .cell = cell.cell.child(octant, cell.planes),
                            .first = first,
                            .count = cell.child_counts[octant],
                            .separated = cell.separable()});
        first += cell.child_counts[octant];
      }
    }
    octree_.nodes.resize(octree_.nodes.size() + children.size());
    hand_down(children, first);
  }

  /// Copy the objects of the open cells into the lists of their children.
  void hand_down(std::vector<OpenCell>& children, std::uint64_t references) {
    std::vector<std::uint32_t> lists(references);
    for_each_below(cells_.size(), [&](std::size_t i) {
      std::array<std::uint64_t, 8> next;
      for (int octant = 0; octant < 8; ++octant) next[octant] = children[8 * i + octant].first;
      for (std::uint64_t k = cells_[i].first; k < cells_[i].first + cells_[i].count; ++k)
        for (unsigned octants = octants_[k]; octants != 0; octants &= octants - 1)
          lists[next[std::countr_zero(octants)]++] = objects_[k];
    });
    objects_ = std::move(lists);
    cells_ = std::move(children);
  }

  const Geometry<Real>& geometry_;
  OctreeLimits limits_;
  std::uint64_t max_references_;
  int max_depth_ = 0;
  /// By how much a cell is widened before it is compared with a surface.
  Real margin_ = 0;
  Octree<Real> octree_;
  std::vector<OpenCell> cells_;
  std::vector<std::uint32_t> objects_;
  std::vector<std::uint8_t> octants_;
};

}  // namespace

template <class Real>
Octree<Real> build_octree(const Geometry<Real>& geometry, const OctreeLimits& limits) {
  return OctreeBuilder<Real>(geometry, limits).build();
}

template Octree<float> build_octree(const Geometry<float>&, const OctreeLimits&);
template Octree<double> build_octree(const Geometry<double>&, const OctreeLimits&);

}  // namespace rayshoot
