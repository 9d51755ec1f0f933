// Hierarchy of parallelepipeds, traversed by estimated distance (Arvo & Kirk §4.3 and §4.4)
// T. Kay, J. Kajiya, "Ray tracing complex scenes", 1986.
//
// Idea       A pair of parallel planes brackets an object between them; some such slabs, of the same few orientations for
//            all objects, come as near to its convex hull as one likes. What a ray has to do with an orientation is done
//            once a ray, so a slab costs next to nothing. A heap hands out objects and volumes by the distance at which
//            the ray enters them: nothing is tested that the nearest hit hides.
// Parameters plane_sets   orientations: 3 are boxes, 5 and 7 add the diagonals of the cube, 9 and 13 those of its faces,
//                         in that order, so that more of them never test more; 7, as in the paper's examples, which where
//                         objects are cheap costs up to a quarter more time than 3
//            hierarchy    modeller takes the grouping that the scene's generator states, automatic clusters, median halves
//                         the objects along x, y and z in turn, as the paper does; modeller, which takes a third to two
//                         thirds of the time of median
//            resolution   cells of the clustering histogram along the longest axis; 8
//            max_objects  objects that a node may hold itself, each in its own volume; 1
// Cost       equation (3), with the surface areas of the parallelepipeds; occlusion neglected. Two dot products a ray and
//            sloping orientation, counted as `dot_products`.
// Weak       where objects are cheap to test: a heap costs more than a stack, sloping slabs more than a box.
// Exactness  slabs along the axes are boxes, met as everywhere; sloping ones are widened once a ray by what a hit may lie
//            beside its surface.

#include <tbb/parallel_for.h>

#include "accel/core/define_technique.h"
#include "accel/parts/object_hierarchy.h"
#include "accel/parts/plane_sets.h"

namespace rayshoot {

namespace {

constexpr std::uint32_t kNone = 0xFFFFFFFFu;

struct KayKajiyaConfig {
  HierarchyConfig hierarchy;
  int plane_sets = 7;
};

template <class Real>
class BvhKayKajiya {
 public:
  using Scalar = Real;
  using Config = KayKajiyaConfig;

  /// A volume that a ray may enter: about the object at position `first`, or about the candidates [first, last).
  struct Candidate {
    Box<Real> box;
    std::uint32_t first, last;

    bool is_object() const { return last == kNone; }
  };
  /// A candidate on the heap, by its estimated distance.
  struct Estimated {
    Real distance;
    std::uint32_t candidate;

    friend bool operator<(const Estimated& a, const Estimated& b) { return a.distance > b.distance; }
  };
  struct Scratch {
    std::vector<Estimated> heap;
  };

  static TechniqueInfo info() {
    std::vector<Parameter> parameters{choice_parameter("plane_sets", "7", {"3", "5", "7", "9", "13"},
                                                       "orientations of the slabs that bound everything")};
    for (Parameter& parameter : hierarchy_parameters({.max_objects = 1}))
      parameters.push_back(std::move(parameter));
    return {.id = "bvh_kay_kajiya",
            .title = "Hierarchy of slabs of few orientations, nearest first",
            .family = "bounding_volume",
            .survey_section = "4",
            .paper = "Kay & Kajiya 1986",
            .parameters = std::move(parameters),
            .events = {"dot_products"}};
  }
  static Config configure(const Arguments& arguments) {
    return {hierarchy_config(arguments), std::stoi(arguments.text("plane_sets"))};
  }

  static BvhKayKajiya build(const BuildInput<Real>& in, const Config& config) {
    // Bracket every object, and from these the groups of them.
    BvhKayKajiya bvh;
    bvh.slopes_ = config.plane_sets - 3;
    bvh.bounds_ = in.geometry.bounds();
    const ObjectHierarchy hierarchy = object_hierarchy(in.geometry, config.hierarchy);
    bvh.order_ = hierarchy.order;
    const std::vector<SlopeExtents> of_objects = bvh.bracket_objects(in.geometry);
    if (!hierarchy.nodes.empty()) bvh.lay_out(in.geometry, hierarchy, of_objects);
    return bvh;
  }

  Scratch scratch() const { return {}; }
  std::span<const std::uint32_t> order() const { return order_; }

  template <class Counter, class L>
  void visit(const Ray<Real>& ray, Scratch& scratch, Counter count, L& leaf) const {
    switch (slopes_) {
      case 0:
        return traverse<0>(ray, scratch.heap, count, leaf);
      case 2:
        return traverse<2>(ray, scratch.heap, count, leaf);
      case 4:
        return traverse<4>(ray, scratch.heap, count, leaf);
      case 6:
        return traverse<6>(ray, scratch.heap, count, leaf);
      default:
        return traverse<10>(ray, scratch.heap, count, leaf);
    }
  }

  StructureStats structure() const {
    return {.nodes = candidates_.size(),
            .leaves = order_.size(),
            .references = order_.size(),
            .max_depth = max_depth_,
            .bytes = candidates_.size() * sizeof(Candidate) + slabs_.size() * sizeof(Real) +
                     order_.size() * sizeof(order_[0])};
  }

  /// Equation (3): a group that is entered costs a volume test for each of its candidates, an object that is entered an
  /// object test.
  Prediction<Real> predicted() const {
    std::vector<double> areas(candidates_.size());
    tbb::parallel_for(std::size_t{0}, areas.size(), [&](std::size_t i) {
      areas[i] = surface_area(candidates_[i].box, extents_of(i), slopes_);
    });
    Prediction<Real> sum{0, candidates_.empty() ? 0.0 : 1.0, bounds_};
    for (std::size_t i = 0; i < areas.size(); ++i) {
      const Candidate& candidate = candidates_[i];
      const double probability = areas[i] / bounds_.surface_area();
      if (candidate.is_object())
        sum.object_tests += probability;
      else
        sum.volume_tests += probability * (candidate.last - candidate.first);
    }
    return sum;
  }

  template <class Visit>
  void for_each_volume(const Visit& visit) const {
    visit(HierarchyVolume{.volume_tests = 1});
    if (!candidates_.empty()) visit_below(candidates_[0], 1, visit);
  }

 private:
  template <class Visit>
  void visit_below(const Candidate& candidate, std::uint32_t depth, const Visit& visit) const {
    if (candidate.is_object())
      return visit(HierarchyVolume{depth, 0, 1, candidate.first, candidate.first + 1});
    visit(HierarchyVolume{.depth = depth, .volume_tests = candidate.last - candidate.first});
    for (std::uint32_t i = candidate.first; i < candidate.last; ++i)
      visit_below(candidates_[i], depth + 1, visit);
  }

  /// The procedure of Figure 9.
  template <int kSlopes, class Counter, class L>
  void traverse(const Ray<Real>& ray, std::vector<Estimated>& heap, Counter count, L& leaf) const {
    if (candidates_.empty()) return;
    // Work out what the ray has to do with each orientation.
    const Crossings<Real> crossings(ray);
    const SlopeCrossings<Real, kSlopes> slopes(ray, bounds_);
    count.event(0, 2 * kSlopes);
    const auto add_if_entered = [&](std::uint32_t i) {
      count.volume_tests();
      const Real* lo = slabs_.data() + static_cast<std::size_t>(i) * 2 * kSlopes;
      const Interval<Real> inside = slopes.inside(crossings.inside(candidates_[i].box), lo, lo + kSlopes);
      const Real enter = std::max(inside.enter, ray.t_min);
      if (enter > std::min(inside.exit, leaf.reach())) return;
      heap.push_back({enter, i});
      std::push_heap(heap.begin(), heap.end());
    };
    heap.clear();
    add_if_entered(0);
    while (!heap.empty()) {
      // Take the candidate of the least estimated distance; a hit before it hides all that are left.
      if (heap.front().distance > leaf.reach()) return;
      const Candidate& candidate = candidates_[heap.front().candidate];
      std::pop_heap(heap.begin(), heap.end());
      heap.pop_back();

      // Test the object, or add the candidates within that the ray enters.
      if (candidate.is_object()) {
        count.cell(false);
        if (leaf(candidate.first)) return;
      } else {
        count.step();
        for (std::uint32_t i = candidate.first; i < candidate.last; ++i) add_if_entered(i);
      }
    }
  }

  /// What each object reaches, by its position.
  std::vector<SlopeExtents> bracket_objects(const Geometry<Real>& geometry) const {
    std::vector<SlopeExtents> extents(slopes_ > 0 ? order_.size() : 0);
    tbb::parallel_for(std::size_t{0}, extents.size(), [&](std::size_t position) {
      std::vector<SurfaceBall> balls;
      append_surface(geometry, order_[position], balls);
      for (const SurfaceBall& ball : balls) extents[position].include(ball);
    });
    return extents;
  }

  /// Put the candidates of a group side by side: its own objects, then the groups in it. A group of one object is that
  /// object.
  void lay_out(const Geometry<Real>& geometry, const ObjectHierarchy& hierarchy,
               const std::vector<SlopeExtents>& of_objects) {
    struct Source {
      std::uint32_t node;
      std::uint64_t depth;
    };
    std::vector<Source> sources;
    const auto place_object = [&](std::uint32_t position, std::uint64_t depth) {
      max_depth_ = std::max(max_depth_, depth);
      sources.push_back({kNone, depth});
      candidates_.push_back({geometry.bounds(order_[position]), position, kNone});
      append_slabs(std::span(of_objects).subspan(slopes_ > 0 ? position : 0, slopes_ > 0 ? 1 : 0));
    };
    const auto place = [&](std::uint32_t number, std::uint64_t depth) {
      const ObjectHierarchy::Node& node = hierarchy.nodes[number];
      if (node.last - node.first == 1) return place_object(node.first, depth);
      sources.push_back({number, depth});
      candidates_.push_back({{}, 0, 0});
      for (std::uint32_t i = node.first; i < node.last; ++i)
        candidates_.back().box.include(geometry.bounds(order_[i]));
      append_slabs(std::span(of_objects)
                       .subspan(slopes_ > 0 ? node.first : 0, slopes_ > 0 ? node.last - node.first : 0));
    };
    place(0, 0);
    for (std::size_t next = 0; next < sources.size(); ++next) {
      const auto [number, depth] = sources[next];
      if (number == kNone) continue;
      const ObjectHierarchy::Node& node = hierarchy.nodes[number];
      candidates_[next].first = static_cast<std::uint32_t>(candidates_.size());
      for (std::uint32_t i = node.first; i < node.own_last; ++i) place_object(i, depth + 1);
      for (std::uint32_t child = number + 1; child < node.end; child = hierarchy.nodes[child].end)
        place(child, depth + 1);
      candidates_[next].last = static_cast<std::uint32_t>(candidates_.size());
    }
  }

  /// The slabs of some objects together, rounded outwards.
  void append_slabs(std::span<const SlopeExtents> of_objects) {
    SlopeExtents all;
    for (const SlopeExtents& extents : of_objects) all.include(extents);
    constexpr Real infinity = Box<Real>::infinity();
    for (int k = 0; k < slopes_; ++k)
      slabs_.push_back(std::nextafter(static_cast<Real>(all.lo[k]), -infinity));
    for (int k = 0; k < slopes_; ++k)
      slabs_.push_back(std::nextafter(static_cast<Real>(all.hi[k]), infinity));
  }

  SlopeExtents extents_of(std::size_t candidate) const {
    SlopeExtents extents;
    const Real* lo = slabs_.data() + candidate * 2 * static_cast<std::size_t>(slopes_);
    std::copy(lo, lo + slopes_, extents.lo.begin());
    std::copy(lo + slopes_, lo + 2 * slopes_, extents.hi.begin());
    return extents;
  }

  std::vector<Candidate> candidates_;
  /// For each candidate the lower planes of all sloping orientations, then the upper ones.
  std::vector<Real> slabs_;
  std::vector<std::uint32_t> order_;
  Box<Real> bounds_;
  int slopes_ = 0;
  std::uint64_t max_depth_ = 0;
};

}  // namespace

RAYSHOOT_TECHNIQUE(bvh_kay_kajiya, BvhKayKajiya)

}  // namespace rayshoot
