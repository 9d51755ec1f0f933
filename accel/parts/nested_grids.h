#pragma once

#include "accel/core/technique.h"
#include "accel/parts/cell_lists.h"
#include "accel/parts/grid_walk.h"
#include "accel/parts/mailbox.h"

namespace rayshoot {

/// What techniques with nested grids count, by position in `TechniqueInfo::events`.
enum NestedGridEvent : std::size_t {
  grids_entered,   ///< nested grids that were walked
  grids_met_again  ///< nested grids that a further cell listed, not walked again
};
inline const std::vector<std::string> kNestedGridEvents = {"grids_entered", "grids_met_again"};

/// Grids that are listed in the cells of other grids as if they were objects. What a cell lists are items: objects by
/// their numbers, and grids by the numbers that follow those of all objects.
template <class Real>
class NestedGrids {
 public:
  struct Grid {
    GridPlanes<Real> planes;
    CellLists cells;
  };

  explicit NestedGrids(std::uint32_t objects = 0) : objects_(objects) {}

  /// Keep a grid, after all that it lists; returns its number as an item.
  std::uint32_t add(Grid grid) {
    grids_.push_back(std::move(grid));
    return objects_ + static_cast<std::uint32_t>(grids_.size() - 1);
  }

  std::uint32_t size() const { return static_cast<std::uint32_t>(grids_.size()); }
  bool is_grid(std::uint32_t item) const { return item >= objects_; }
  const Grid& operator[](std::uint32_t item) const { return grids_[item - objects_]; }
  /// The grid's place among all grids, from 0 on.
  std::uint32_t place(std::uint32_t item) const { return item - objects_; }

  /// How many of the items of a cell are objects; they come first.
  std::size_t objects_among(std::span<const std::uint32_t> items) const {
    std::size_t objects = items.size();
    while (objects > 0 && is_grid(items[objects - 1])) --objects;
    return objects;
  }

  /// Call visit(box, key, objects) for each cell of a grid that lists objects.
  template <class Visit>
  void for_each_cell(const Visit& visit) const {
    for (const Grid& grid : grids_)
      grid.cells.for_each_list([&](std::uint64_t cell, std::span<const std::uint32_t> items) {
        const std::span<const std::uint32_t> objects = items.first(objects_among(items));
        if (!objects.empty()) visit(grid.planes.box(grid.planes.block(cell)), objects.data(), objects);
      });
  }

  /// Nodes are the grids and those of their cells that list no grid, which are the leaves.
  StructureStats structure() const {
    StructureStats stats{.nodes = grids_.size()};
    for (const Grid& grid : grids_) {
      stats.bytes += sizeof(Grid) + grid.planes.bytes() + grid.cells.bytes();
      for (std::uint64_t cell = 0; cell < grid.planes.cells(); ++cell) {
        const std::span<const std::uint32_t> items = grid.cells.objects(cell);
        const std::size_t objects = objects_among(items);
        stats.references += objects;
        stats.leaves += objects == items.size();
        stats.empty_leaves += items.empty();
      }
    }
    stats.nodes += stats.leaves;
    stats.max_depth = levels();
    stats.figures["grids"] = static_cast<double>(grids_.size());
    return stats;
  }

 private:
  /// The most levels of grids one in the other. A grid has a greater number than those it lists.
  std::uint64_t levels() const {
    std::vector<std::uint64_t> levels(grids_.size(), 1);
    for (std::size_t grid = 0; grid < grids_.size(); ++grid)
      for (const std::uint32_t item : grids_[grid].cells.all())
        if (is_grid(item)) levels[grid] = std::max(levels[grid], 1 + levels[place(item)]);
    return levels.empty() ? 0 : *std::max_element(levels.begin(), levels.end());
  }

  std::uint32_t objects_;
  std::vector<Grid> grids_;
};

/// The way of one ray through a grid and the grids listed in its cells. A nested grid is walked where the first cell
/// that lists it is visited, and as far as reach() lets it; where it stands in several cells, a mailbox for the grids
/// keeps the others from walking it again.
///   visit(objects)  is called with the objects of each cell that lists any, or lists nothing; true ends the walk
template <class Real, class Counter, class Reach, class Visit>
class NestedWalk {
 public:
  NestedWalk(const NestedGrids<Real>& grids, Mailbox& walked, const Ray<Real>& ray, Counter count,
             const Reach& reach, const Visit& visit)
      : grids_(grids),
        walked_(walked),
        ray_(ray),
        crossings_(ray),
        count_(count),
        reach_(reach),
        visit_(visit) {
    if (walked.in_use()) walked.begin_ray();
  }

  /// Walk through a grid; true when the visit must end.
  bool through(std::uint32_t item) {
    const auto& grid = grids_[item];
    bool over = false;
    walk_grid(grid.planes, ray_, crossings_, count_, reach_,
              [&](std::uint64_t cell) { return over = visit_items(grid.cells.objects(cell)); });
    return over;
  }

  /// Visit the objects of a cell and walk through the grids it lists, which follow them; true when the visit must end.
  bool visit_items(std::span<const std::uint32_t> items) {
    const std::size_t objects = grids_.objects_among(items);
    if (objects == items.size()) return visit_(items);
    if (objects > 0 && visit_(items.first(objects))) return true;
    for (const std::uint32_t grid : items.subspan(objects))
      if (walked_.in_use() && !walked_.first_visit(grids_.place(grid)))
        count_.event(grids_met_again);
      else if (enter(grid))
        return true;
    return false;
  }

 private:
  /// Go down into a nested grid.
  [[gnu::noinline]] bool enter(std::uint32_t grid) {
    count_.step(), count_.event(grids_entered);
    return through(grid);
  }

  const NestedGrids<Real>& grids_;
  Mailbox& walked_;
  const Ray<Real>& ray_;
  Crossings<Real> crossings_;
  Counter count_;
  const Reach& reach_;
  const Visit& visit_;
};

/// What a thread remembers of a ray: the objects it has met, and the grids.
struct NestedScratch {
  Mailbox objects, grids;
};

/// The cells of a ray in an outermost grid and those nested in it, with the mailbox of a thread for grids (visit_cells.h).
template <class Real>
struct NestedOnRay {
  const NestedGrids<Real>& grids;
  std::uint32_t outermost;
  Mailbox& walked;

  template <class Counter, class Reach, class Visit>
  void visit_cells(const Ray<Real>& ray, Counter count, const Reach& reach, const Visit& visit) const {
    if (grids.size() == 0) return;
    NestedWalk<Real, Counter, Reach, Visit>(grids, walked, ray, count, reach, visit).through(outermost);
  }
};

}  // namespace rayshoot
