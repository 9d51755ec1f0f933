#pragma once

#include <algorithm>
#include <concepts>
#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "accel/core/counters.h"
#include "scenes/core/geometry.h"
#include "scenes/core/spec.h"

namespace rayshoot {

/// What a technique is, as listed.
struct TechniqueInfo {
  std::string id;
  std::string title;
  /// Folder of the technique: a section of the survey.
  std::string family;
  /// Section of Arvo and Kirk's survey.
  std::string survey_section;
  std::string paper;
  std::vector<Parameter> parameters;
  /// Names, in snake case, of what the technique counts beyond the common counts (`Count::event`).
  std::vector<std::string> events{};
  /// Beyond this many objects a query is out of reach and the technique is left out of suites.
  std::uint64_t max_practical_objects = UINT64_MAX;
  /// It replays known hits instead of searching for them.
  bool needs_recorded_hits = false;
  /// Its ray-object test is its own, so its hits may differ from the harness's in the last digits.
  bool own_object_test = false;
  /// It is a point of comparison, not a technique of the papers.
  bool baseline = false;
};

/// Rays like those that will be traced, for techniques that look at some of them before they build; none where
/// nobody knows what will be traced. They live as long as the build.
template <class Real>
struct RaySample {
  std::span<const Ray<Real>> rays{};
  /// So many rays each of them stands for.
  double rays_each = 1;
};

/// What a technique is built from. The geometry outlives the technique.
template <class Real>
struct BuildInput {
  const Geometry<Real>& geometry;
  RaySample<Real> sample{};
};

/// Size and shape of what was built.
struct StructureStats {
  std::uint64_t nodes = 0;         ///< all nodes or cells, leaves included
  std::uint64_t leaves = 0;        ///< cells or nodes that hold objects directly, or nothing
  std::uint64_t empty_leaves = 0;  ///< of these, those without objects
  std::uint64_t references = 0;    ///< object references in leaves
  std::uint64_t max_depth = 0;     ///< of the root: 0
  std::uint64_t bytes = 0;         ///< memory of the structure, without the objects themselves
  /// What only this technique has, by name in snake case, with the unit in the name.
  std::map<std::string, double> figures{};

  /// Add what stands beside it; figures are not added.
  StructureStats& operator+=(const StructureStats& other);
};

inline StructureStats& StructureStats::operator+=(const StructureStats& other) {
  nodes += other.nodes, leaves += other.leaves, empty_leaves += other.empty_leaves;
  references += other.references, bytes += other.bytes;
  max_depth = std::max(max_depth, other.max_depth);
  return *this;
}

/// Equation (3): expected tests per ray that hits the root volume, occlusion neglected, and that volume.
template <class Real>
struct Prediction {
  double object_tests = 0;
  double volume_tests = 0;
  Box<Real> root;
};

/// A volume of a hierarchy, by what is tested when a ray enters it.
struct HierarchyVolume {
  std::uint32_t depth = 0;            ///< of what every ray enters: 0
  std::uint32_t volume_tests = 0;     ///< of the volumes right below it
  std::uint32_t object_tests = 0;     ///< of objects
  std::uint32_t first = 0, last = 0;  ///< objects in no volume below it, as its leaf is given them
};

/// A leaf is what a query hands to `visit`: it tests the objects it is given and remembers the outcome.
///   leaf(object)  tests one candidate; true when the query is answered and the visit must end
///   leaf.reach()  the distance beyond which nothing matters any more; a hit at exactly that distance still
///   does
template <class L, class Real>
concept Leaf = requires(L leaf, std::uint32_t object) {
  { leaf(object) } -> std::same_as<bool>;
  { leaf.reach() } -> std::convertible_to<Real>;
};

/// The leaf that the concept below is checked with.
template <class Real>
struct ArchetypeLeaf {
  bool operator()(std::uint32_t) { return false; }
  Real reach() const { return 0; }
};

/// What answers queries: it visits candidates, near to far where it can. Everything else is derived from `visit`
/// (accel/core/queries.h). It is immutable; what a query changes lives in its Scratch.
///
/// It may also define
///   std::span<const std::uint32_t> order() const   to give the leaf positions in that order of the objects instead of
///       objects; the objects are then laid out in memory in that order, each at least once;
///   std::size_t rays_per_batch() const             to ask for more rays at a time than `kRaysPerBatch`;
///   Prediction<Real> predicted() const             to state what equation (3) expects; std::optional where it can do
///       so for some configurations only;
///   for_each_volume(visit)                         where it is a hierarchy and each object is in one place of it: calls
///       visit(HierarchyVolume) for each volume, before those below it, depth first; for no configuration of which that
///       cannot be said.
template <class A>
concept Visitable = requires(const A a, typename A::Scratch scratch, Ray<typename A::Scalar> ray,
                             NoCount none, Count count, ArchetypeLeaf<typename A::Scalar> leaf) {
  {a.visit(ray, scratch, none, leaf)};
  {a.visit(ray, scratch, count, leaf)};
  { a.structure() } -> std::same_as<StructureStats>;
  { a.scratch() } -> std::same_as<typename A::Scratch>;
};

/// A technique is built once from a scene and its parameters. One whose candidates are the objects of the cells on the ray may
/// also define, to be the first part of a composition (optimizer.h),
///   prepare_cells()        optional; called once before the others
///   cells(scratch)         what has visit_cells (parts/visit_cells.h)
///   for_each_cell(visit)   calls visit(box, key, positions) for each cell with objects: `positions` are the list that
///                          visit_cells hands out, and `key` is where it stands
///   widens_cells()         optional; whether some rays are shown cells that they pass by (parts/surface_margin.h)
template <class A>
concept Technique = Visitable<A> && requires(BuildInput<typename A::Scalar> in, const Arguments& arguments) {
  { A::info() } -> std::same_as<TechniqueInfo>;
  { A::configure(arguments) } -> std::same_as<typename A::Config>;
  { A::build(in, typename A::Config{}) } -> std::same_as<A>;
};

/// A technique that lays its objects out in an order of its own.
template <class A>
concept OrdersObjects = requires(const A a) {
  { a.order() } -> std::convertible_to<std::span<const std::uint32_t>>;
};

}  // namespace rayshoot
