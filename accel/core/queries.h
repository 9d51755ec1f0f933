#pragma once

#include <algorithm>
#include <vector>

#include "accel/core/technique.h"

namespace rayshoot {

/// The ray-object test for scenes of any kind, and for any intersector.
template <class Real>
struct ObjectTest {
  const Geometry<Real>& geometry;

  Real operator()(std::uint32_t position, const Ray<Real>& ray) const {
    return geometry.hit_distance(position, ray);
  }
};

/// The same for scenes of triangles mostly, and one intersector: code for other kinds is kept out of the way.
template <class Real, Intersector kIntersector>
struct TriangleTest {
  const Geometry<Real>& geometry;

  Real operator()(std::uint32_t position, const Ray<Real>& ray) const {
    return geometry.template triangle_hit_distance<kIntersector>(position, ray);
  }
};

/// Call `function` with the cheapest ray-object test that serves the scene's kinds of objects and its intersector.
template <class Real, class Function>
void with_object_test(const Geometry<Real>& geometry, const Function& function) {
  if (!geometry.mostly_triangles() || geometry.intersector() == Intersector::exact)
    function(ObjectTest<Real>{geometry});
  else if (geometry.intersector() == Intersector::watertight)
    function(TriangleTest<Real, Intersector::watertight>{geometry});
  else
    function(TriangleTest<Real, Intersector::fast>{geometry});
}

/// Which object stands at a position of the technique's own order; the identity where it has none.
struct Naming {
  const std::uint32_t* order = nullptr;
  std::uint32_t operator()(std::uint32_t position) const { return order ? order[position] : position; }
};

/// Whether a leaf ends the visit at the first hit it is given: near objects first are then of no use to it.
template <class L>
inline constexpr bool kSeeksAnyHit = false;
template <class L>
requires(L::kAnyHit) inline constexpr bool kSeeksAnyHit<L> = true;

/// Leaf of the closest-hit query: keeps the nearest hit, of equal distances the lowest object.
template <class Real, class Test>
class ClosestLeaf {
 public:
  ClosestLeaf(const Test& test, Naming name, const Ray<Real>& ray) : test_(test), name_(name), ray_(ray) {}

  bool operator()(std::uint32_t position) {
    const Real t = test_(position, ray_);
    if (t <= ray_.t_max) keep(t, name_(position));
    return false;
  }
  Real reach() const { return ray_.t_max; }
  const Hit<Real>& hit() const { return hit_; }

 private:
  void keep(Real t, std::uint32_t object) {
    if (t == hit_.t && object > hit_.object) return;
    hit_ = {t, object};
    ray_.t_max = t;
  }

  const Test& test_;
  Naming name_;
  Ray<Real> ray_;
  Hit<Real> hit_;
};

/// Leaf of the any-hit query: ends the visit at the first hit.
template <class Real, class Test>
class AnyLeaf {
 public:
  static constexpr bool kAnyHit = true;

  AnyLeaf(const Test& test, Naming, const Ray<Real>& ray) : test_(test), ray_(ray) {}

  bool operator()(std::uint32_t position) { return blocked_ = test_(position, ray_) <= ray_.t_max; }
  Real reach() const { return ray_.t_max; }
  bool blocked() const { return blocked_; }

 private:
  const Test& test_;
  const Ray<Real>& ray_;
  bool blocked_ = false;
};

/// Leaf of the strict optimizer: never stops and never shortens the ray, so every cell on it is visited.
template <class Real, class Test>
class StrictLeaf {
 public:
  StrictLeaf(const Test&, Naming, const Ray<Real>& ray) : reach_(ray.t_max) {}

  bool operator()(std::uint32_t) { return false; }
  Real reach() const { return reach_; }

 private:
  Real reach_;
};

/// Leaf of a search that knows all objects on the ray and tests none: one of them shortens the ray, or ends the visit,
/// when it is handed out.
template <class Real, bool kSeeksAny>
class KnownHitsLeaf {
 public:
  static constexpr bool kAnyHit = kSeeksAny;

  KnownHitsLeaf(std::span<const Hit<Real>> known, Naming name, const Ray<Real>& ray)
      : known_(known), name_(name), reach_(ray.t_max) {}

  bool operator()(std::uint32_t position) {
    const auto found =
        std::lower_bound(known_.begin(), known_.end(), name_(position),
                         [](const Hit<Real>& hit, auto object) { return hit.object < object; });
    if (found == known_.end() || found->object != name_(position)) return false;
    reach_ = std::min(reach_, found->t);
    return kSeeksAny;
  }
  Real reach() const { return reach_; }

 private:
  std::span<const Hit<Real>> known_;
  Naming name_;
  Real reach_;
};

/// Wraps another leaf and records the position of every candidate it is given, repetitions included.
template <class Inner>
class RecordingLeaf {
 public:
  static constexpr bool kAnyHit = kSeeksAnyHit<Inner>;

  RecordingLeaf(Inner& inner, std::vector<std::uint32_t>& candidates)
      : inner_(inner), candidates_(candidates) {}

  bool operator()(std::uint32_t position) {
    candidates_.push_back(position);
    return inner_(position);
  }
  auto reach() const { return inner_.reach(); }

 private:
  Inner& inner_;
  std::vector<std::uint32_t>& candidates_;
};

/// The ray as techniques expect it: it begins at 0 at the earliest, also where its t_min is negative or no number, for from
/// such a t_min steps need not advance; and its time is one from 0 to 1.
template <class Real>
Ray<Real> begun(Ray<Real> ray) {
  ray.t_min = std::max(Real{0}, ray.t_min);
  ray.time = std::min(std::max(Real{0}, ray.time), Real{1});
  return ray;
}

/// The nearest hit of a ray that has `begun`.
template <Visitable A, class Real, class Test>
Hit<Real> closest_hit(const A& technique, const Test& test, Naming name, const Ray<Real>& ray,
                      typename A::Scratch& scratch) {
  ClosestLeaf<Real, Test> leaf(test, name, ray);
  technique.visit(ray, scratch, NoCount{}, leaf);
  return leaf.hit();
}

/// Whether a ray that has `begun` meets anything.
template <Visitable A, class Real, class Test>
bool any_hit(const A& technique, const Test& test, Naming name, const Ray<Real>& ray,
             typename A::Scratch& scratch) {
  AnyLeaf<Real, Test> leaf(test, name, ray);
  technique.visit(ray, scratch, NoCount{}, leaf);
  return leaf.blocked();
}

/// Visit for a ray that has `begun` with `leaf`, counting all work but distinct objects, and leave every candidate in `candidates`:
/// Revelles' optimizer A(r, s) with a ClosestLeaf, the strict optimizer with a StrictLeaf.
template <Visitable A, class Real, class Inner>
void counted_visit(const A& technique, const Ray<Real>& ray, typename A::Scratch& scratch, Work& work,
                   Inner& leaf, std::vector<std::uint32_t>& candidates) {
  candidates.clear();
  RecordingLeaf<Inner> recorder(leaf, candidates);
  technique.visit(ray, scratch, Count(work), recorder);
  ++work.rays;
  work.object_tests += candidates.size();
}

}  // namespace rayshoot
