// Hierarchy of uniform grids, HUG (Arvo & Kirk §5.1, nonuniform subdivision)
// F. Cazals, G. Drettakis, C. Puech, "Filtering, clustering and hierarchy construction: a new solution for ray-tracing
// complex scenes", 1995.
//
// Idea       Filter the objects into levels by size, cluster those of a level that are close to each other, and give each
//            cluster a uniform grid, which suits it, for its objects are alike and fill it. A grid is listed like an
//            object in the cells of the smallest grid of larger objects that holds it, or of the scene's.
// Parameters levels        filter levels, equal parts of the logarithm of the size from the smallest object's to the
//                          largest's, and at least a factor of 2; 2 levels, since a third costs more in walks from
//                          grid to grid than it saves
//            connectivity  objects are close when their boxes meet, each grown by this times its diagonal; 0: they touch;
//                          below 0 they must overlap
//            min_cluster   a cluster of fewer objects gets no grid: they are listed where the grid would be; 8
//            density       cells of a grid per object or grid listed in it; 3
//            resolution    heterogeneous: cubic cells
//            mailbox       auto: where some object is listed twice
// Cost       in each grid as in a uniform one, and a walk from border to border for every grid that the ray meets.
// Weak       clusters that enclose one another, whose grids overlap: a ray walks one to its end, or to a hit, before it
//            comes to the next; sizes that do not fall into groups.
//
// The paper chooses the sizes that separate the levels from their histogram; here they are equally spaced.

#include <boost/geometry.hpp>
#include <boost/geometry/index/rtree.hpp>
#include <cmath>

#include "accel/core/define_technique.h"
#include "accel/parts/grid_division.h"
#include "accel/parts/nested_grids.h"
#include "accel/parts/visit_cells.h"

namespace rayshoot {

namespace {

struct HugConfig {
  int levels = 0;
  double connectivity = 0;
  std::uint32_t min_cluster = 0;
  double density = 0;
  ResolutionRule rule = ResolutionRule::heterogeneous;
  MailboxUse mailbox = MailboxUse::automatic;
};

/// Objects of a level that are close to each other, in increasing order, with the grids listed among them.
template <class Real>
struct Cluster {
  Box<Real> box;
  std::vector<std::uint32_t> items;
};

/// Search among boxes, which have numbers.
namespace index {
using Point = boost::geometry::model::point<double, 3, boost::geometry::cs::cartesian>;
using Box3 = boost::geometry::model::box<Point>;
using Entry = std::pair<Box3, std::uint32_t>;
struct SameNumber {
  bool operator()(const Entry& a, const Entry& b) const { return a.second == b.second; }
};
using Tree = boost::geometry::index::rtree<Entry, boost::geometry::index::quadratic<16>,
                                           boost::geometry::index::indexable<Entry>, SameNumber>;

template <class Real>
Box3 box3(const Box<Real>& box) {
  return {{box.lo.x, box.lo.y, box.lo.z}, {box.hi.x, box.hi.y, box.hi.z}};
}
}  // namespace index

template <class Real>
class HugBuilder {
 public:
  HugBuilder(const Geometry<Real>& geometry, const HugConfig& config, NestedGrids<Real>& grids)
      : geometry_(geometry), config_(config), grids_(grids), allowance_(geometry.size()) {}

  /// The outermost grid.
  std::uint32_t build() {
    clusters_.push_back({geometry_.bounds(), {}});
    for (const std::vector<std::uint32_t>& level : filtered()) add_level(clusters_of(level));

    // Make the grids of the smallest objects first: those that list them follow.
    for (std::size_t cluster = clusters_.size(); --cluster > 0;)
      clusters_[parent_[cluster]].items.push_back(grid(clusters_[cluster]));
    return grid(clusters_[0]);
  }

 private:
  /// Filtering: the objects by size, the largest first.
  std::vector<std::vector<std::uint32_t>> filtered() const {
    double smallest = Box<double>::infinity(), largest = 0;
    for (std::uint32_t object = 0; object < geometry_.size(); ++object) {
      const double size = diagonal(object);
      if (size > 0) smallest = std::min(smallest, size);
      largest = std::max(largest, size);
    }
    const double width = std::max(std::log(largest / smallest) / config_.levels, std::log(2));
    std::vector<std::vector<std::uint32_t>> levels(static_cast<std::size_t>(config_.levels));
    for (std::uint32_t object = 0; object < geometry_.size(); ++object) {
      const double below = std::log(largest / std::max(diagonal(object), smallest)) / width;
      const int level = below > 0 ? static_cast<int>(std::min(below, config_.levels - 1.0)) : 0;
      levels[static_cast<std::size_t>(level)].push_back(object);
    }
    return levels;
  }

  /// Clustering: the groups of a level of which each object is close to another.
  std::vector<Cluster<Real>> clusters_of(const std::vector<std::uint32_t>& level) const {
    std::vector<index::Entry> entries;
    for (const std::uint32_t object : level) entries.emplace_back(neighbourhood(object), object);
    index::Tree rest(entries);
    std::vector<Cluster<Real>> clusters;
    std::vector<index::Entry> found;
    while (!rest.empty()) {
      // Begin with any object, and take what is close to those that were taken, until nothing is.
      found.assign(1, *rest.begin());
      rest.remove(found[0]);
      for (std::size_t taken = 0; taken < found.size(); ++taken) {
        const std::size_t known = found.size();
        rest.query(boost::geometry::index::intersects(index::Box3(found[taken].first)),
                   std::back_inserter(found));
        rest.remove(found.begin() + static_cast<std::ptrdiff_t>(known), found.end());
      }
      Cluster<Real>& cluster = clusters.emplace_back();
      for (const auto& [box, object] : found) {
        cluster.box.include(geometry_.bounds(object));
        cluster.items.push_back(object);
      }
      std::sort(cluster.items.begin(), cluster.items.end());
    }
    return clusters;
  }

  /// Hierarchy construction: each cluster belongs to the smallest of larger objects that holds it.
  void add_level(std::vector<Cluster<Real>>&& level) {
    const std::size_t coarser = clusters_.size();
    for (Cluster<Real>& cluster : level) {
      const std::uint32_t parent = smallest_around(cluster.box);
      if (cluster.items.size() < config_.min_cluster) {
        std::vector<std::uint32_t>& items = clusters_[parent].items;
        items.insert(items.end(), cluster.items.begin(), cluster.items.end());
      } else {
        clusters_.push_back(std::move(cluster));
        parent_.push_back(parent);
      }
    }
    for (std::size_t cluster = coarser; cluster < clusters_.size(); ++cluster)
      coarser_.insert({index::box3(clusters_[cluster].box), static_cast<std::uint32_t>(cluster)});
  }

  std::uint32_t smallest_around(const Box<Real>& box) const {
    std::uint32_t smallest = 0;
    const auto met = boost::geometry::index::intersects(index::box3(box));
    for (auto entry = coarser_.qbegin(met); entry != coarser_.qend(); ++entry) {
      const Box<Real>& around = clusters_[entry->second].box;
      if (around.contains(box) && around.surface_area() <= clusters_[smallest].box.surface_area())
        smallest = entry->second;
    }
    return smallest;
  }

  /// The grid of a cluster.
  std::uint32_t grid(Cluster<Real>& cluster) {
    std::sort(cluster.items.begin(), cluster.items.end());
    const std::vector<std::uint32_t>& items = cluster.items;
    const auto bounds_of = [&](std::uint32_t i) {
      return grids_.is_grid(items[i]) ? grids_[items[i]].planes.bounds() : geometry_.bounds(items[i]);
    };
    const GridDivision<Real> division = allowance_.template division<Real>(
        cluster.box, config_.rule, config_.density * static_cast<double>(items.size()),
        static_cast<std::uint32_t>(items.size()), bounds_of);
    allowance_.take(division);
    CellLists cells = division.lists(bounds_of);
    cells.renumber(items);
    return grids_.add({division.planes, std::move(cells)});
  }

  double diagonal(std::uint32_t object) const {
    const Box<Real> box = geometry_.bounds(object);
    return std::hypot(double{box.hi.x} - box.lo.x, double{box.hi.y} - box.lo.y, double{box.hi.z} - box.lo.z);
  }

  /// The object's box, grown or shrunk, but never turned inside out.
  index::Box3 neighbourhood(std::uint32_t object) const {
    const Box<double> box{Vec3d(geometry_.bounds(object).lo), Vec3d(geometry_.bounds(object).hi)};
    const double by = config_.connectivity * diagonal(object);
    Box<double> grown;
    for (int axis = 0; axis < 3; ++axis) {
      const double growth = std::max(by, -0.5 * (box.hi[axis] - box.lo[axis]));
      grown.lo[axis] = box.lo[axis] - growth;
      grown.hi[axis] = std::max(grown.lo[axis], box.hi[axis] + growth);
    }
    return index::box3(grown);
  }

  const Geometry<Real>& geometry_;
  const HugConfig& config_;
  NestedGrids<Real>& grids_;
  GridAllowance allowance_;
  /// The scene's, then those of the largest objects, and so on; the place of that in which each is listed.
  std::vector<Cluster<Real>> clusters_;
  std::vector<std::uint32_t> parent_{0};
  /// Clusters of the levels that are complete, without the scene's.
  index::Tree coarser_;
};

template <class Real>
class Hug {
 public:
  using Scalar = Real;
  using Config = HugConfig;
  using Scratch = NestedScratch;

  static TechniqueInfo info() {
    return {
        .id = "hug",
        .title = "Hierarchy of uniform grids by size and clustering",
        .family = "grid",
        .survey_section = "5.1",
        .paper = "Cazals, Drettakis & Puech 1995",
        .parameters = {integer_parameter("levels", 2, 1, 16, "levels of sizes"),
                       real_parameter("connectivity", 0, -1, 16,
                                      "growth of boxes that makes objects neighbours, in their diagonals"),
                       integer_parameter("min_cluster", 8, 1, 1'000'000,
                                         "a cluster of fewer objects gets no grid"),
                       real_parameter("density", 3, 1e-3, 1e3, "cells per object or grid listed"),
                       resolution_rule_parameter(), mailbox_parameter()},
        .events = kNestedGridEvents};
  }
  static Config configure(const Arguments& arguments) {
    return {.levels = static_cast<int>(arguments.integer("levels")),
            .connectivity = arguments.real("connectivity"),
            .min_cluster = static_cast<std::uint32_t>(arguments.integer("min_cluster")),
            .density = arguments.real("density"),
            .rule = resolution_rule(arguments),
            .mailbox = mailbox_use(arguments)};
  }

  static Hug build(const BuildInput<Real>& in, const Config& config) {
    Hug technique;
    const std::uint32_t objects = in.geometry.size();
    if (objects == 0) return technique;
    technique.grids_ = NestedGrids<Real>(objects);
    technique.root_ = HugBuilder<Real>(in.geometry, config, technique.grids_).build();
    technique.structure_ = technique.grids_.structure();
    if (wants_mailbox(config.mailbox, technique.structure_.references, objects))
      technique.mailboxes_ = objects;
    return technique;
  }

  Scratch scratch() const { return {Mailbox(mailboxes_), Mailbox(grids_.size())}; }

  template <class Counter, class L>
  void visit(const Ray<Real>& ray, Scratch& scratch, Counter count, L& leaf) const {
    visit_objects_of_cells(cells(scratch), ray, scratch.objects, count, leaf);
  }

  NestedOnRay<Real> cells(Scratch& scratch) const { return {grids_, root_, scratch.grids}; }
  template <class Visit>
  void for_each_cell(const Visit& visit) const {
    grids_.for_each_cell(visit);
  }

  StructureStats structure() const { return structure_; }

 private:
  NestedGrids<Real> grids_;
  std::uint32_t root_ = 0;
  StructureStats structure_;
  std::uint32_t mailboxes_ = 0;
};

}  // namespace

RAYSHOOT_TECHNIQUE(hug, Hug)

}  // namespace rayshoot
