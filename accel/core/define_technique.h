#pragma once

#include <algorithm>
#include <mutex>
#include <utility>

#include "accel/core/engine.h"
#include "accel/core/queries.h"
#include "accel/core/technique_optimizer.h"

namespace rayshoot {

/// A technique for which equation (3) predicts the cost.
template <class A>
concept PredictsCost = requires(const A a) {
  { a.predicted() } -> std::convertible_to<std::optional<Prediction<typename A::Scalar>>>;
};

/// A technique that tells its volumes.
template <class A>
concept HasVolumes = requires(const A a, void (*visit)(const HierarchyVolume&)) {
  a.for_each_volume(visit);
};

/// What tests its candidates itself, where they are: `object_test(scratch)` is the test of the one last handed on.
template <class A>
concept TestsObjects = requires(const A a, const typename A::Scratch& scratch) {
  a.object_test(scratch);
};

/// A technique that brings searches of its own, in the instructions of the processor it runs on, for the geometries that
/// they serve: the answers are those of `visit`. They are given the geometry that it was built from.
template <class A>
concept HasKernels = requires(const A a, const Geometry<typename A::Scalar>& geometry,
                              std::span<const Ray<typename A::Scalar>> rays,
                              std::span<Hit<typename A::Scalar>> hits, std::span<std::uint8_t> blocked,
                              typename A::Scratch& scratch) {
  { a.kernels_serve(geometry) } -> std::same_as<bool>;
  {a.kernel_closest(geometry, rays, hits, scratch)};
  {a.kernel_any(geometry, rays, blocked, scratch)};
};

/// Derives the batch interface of an engine from a technique's `visit`.
template <Visitable A>
class TechniqueEngine final : public Engine<typename A::Scalar> {
 public:
  using Real = typename A::Scalar;

  explicit TechniqueEngine(const EngineInput<Real>& input) requires Technique<A>
      : TechniqueEngine(A::build({input.geometry, input.sample}, A::configure(input.arguments)),
                        input.geometry) {}

  TechniqueEngine(A&& technique, const Geometry<Real>& geometry)
      : technique_(std::move(technique)), given_(geometry) {
    if (!has_kernels()) arranged();
  }

  std::unique_ptr<EngineScratch> scratch() const override {
    return std::make_unique<Scratch>(technique_.scratch());
  }

  void closest(std::span<const Ray<Real>> rays, std::span<Hit<Real>> hits,
               EngineScratch& scratch) const override {
    auto& own = static_cast<Scratch&>(scratch).technique;
    if constexpr (HasKernels<A>)
      if (has_kernels()) return technique_.kernel_closest(given_, rays, hits, own);
    with_test(own, [&](const auto& test) { closest_of_all(test, rays, hits, own); });
  }

  void any(std::span<const Ray<Real>> rays, std::span<std::uint8_t> blocked,
           EngineScratch& scratch) const override {
    auto& own = static_cast<Scratch&>(scratch).technique;
    if constexpr (HasKernels<A>)
      if (has_kernels()) return technique_.kernel_any(given_, rays, blocked, own);
    with_test(own, [&](const auto& test) { any_of_all(test, rays, blocked, own); });
  }

  CountedWork count(Query query, std::span<const Ray<Real>> rays, std::span<Hit<Real>> hits,
                    EngineScratch& scratch) const override {
    CountedWork sum;
    auto& own = static_cast<Scratch&>(scratch);
    const auto square = [](double n) { return n * n; };
    double neighbour = 0;
    for (std::size_t i = 0; i < rays.size(); ++i) {
      Work work;
      hits[i] = counted_query(query, rays[i], own, work);
      work.distinct_objects = own.make_distinct(given_.numbers(), name());
      const auto distinct = static_cast<double>(work.distinct_objects);
      sum += {work,
              square(distinct),
              i % 2 == 0 ? 0 : square(distinct - neighbour),
              square(static_cast<double>(work.object_tests)),
              square(static_cast<double>(work.volume_tests)),
              square(static_cast<double>(work.cells))};
      neighbour = distinct;
    }
    return sum;
  }

  std::optional<Work> count_known(Query query, std::span<const Ray<Real>> rays,
                                  std::span<const std::vector<Hit<Real>>> known,
                                  EngineScratch& scratch) const override {
    Work sum;
    auto& own = static_cast<Scratch&>(scratch);
    const auto visit_with = [&](const Ray<Real>& ray, auto leaf) {
      counted_visit(technique_, ray, own.technique, sum, leaf, own.candidates);
    };
    for (std::size_t i = 0; i < rays.size(); ++i) {
      const Ray<Real> ray = begun(rays[i]);
      if (query == Query::any)
        visit_with(ray, KnownHitsLeaf<Real, true>(known[i], name(), ray));
      else
        visit_with(ray, KnownHitsLeaf<Real, false>(known[i], name(), ray));
    }
    return sum;
  }

  std::vector<std::uint32_t> candidates(Query query, const Ray<Real>& ray,
                                        EngineScratch& scratch) const override {
    auto& own = static_cast<Scratch&>(scratch);
    Work work;
    counted_query(query, ray, own, work);
    own.make_distinct(given_.numbers(), name());
    std::sort(own.candidates.begin(), own.candidates.end());
    return own.candidates;
  }

  std::size_t rays_per_batch() const override {
    if constexpr (requires(const A& a) { a.rays_per_batch(); })
      return technique_.rays_per_batch();
    else
      return kRaysPerBatch;
  }
  StructureStats structure() const override { return technique_.structure(); }

  std::optional<Prediction<Real>> predicted() const override {
    if constexpr (PredictsCost<A>)
      return technique_.predicted();
    else
      return std::nullopt;
  }

  std::vector<PathTests> path_tests() const override {
    std::vector<PathTests> tests;
    if constexpr (HasVolumes<A>) {
      // Sum up from the root down to the volume at hand.
      std::vector<PathTests> path;
      technique_.for_each_volume([&](const HierarchyVolume& volume) {
        tests.resize(given_.numbers());
        path.resize(volume.depth);
        const PathTests above = path.empty() ? PathTests{} : path.back();
        path.push_back({above.volume_tests + volume.volume_tests, above.object_tests + volume.object_tests});
        for (std::uint32_t i = volume.first; i < volume.last; ++i) tests[name()(i)] = path.back();
      });
    }
    return tests;
  }

 private:
  struct Scratch final : EngineScratch {
    explicit Scratch(typename A::Scratch own) : technique(std::move(own)) {}

    /// Leave each of the `candidates` in place once, by its name; returns their number.
    std::uint64_t make_distinct(std::uint32_t objects, Naming name) {
      if constexpr (OrdersObjects<A>)
        std::transform(candidates.begin(), candidates.end(), candidates.begin(), name);
      // Where parts are placed there may be more objects than can be remembered.
      if constexpr (TestsObjects<A>) {
        std::sort(candidates.begin(), candidates.end());
        candidates.erase(std::unique(candidates.begin(), candidates.end()), candidates.end());
        return candidates.size();
      }
      last_counted.resize(objects);
      ++counted;
      std::erase_if(candidates, [&](std::uint32_t object) {
        return std::exchange(last_counted[object], counted) == counted;
      });
      return candidates.size();
    }

    typename A::Scratch technique;
    std::vector<std::uint32_t> candidates;
    /// Queries counted so far, and for each object the number of the last that tested it.
    std::uint64_t counted = 0;
    std::vector<std::uint64_t> last_counted;
  };

  bool has_kernels() const {
    if constexpr (HasKernels<A>)
      return technique_.kernels_serve(given_);
    else
      return false;
  }
  /// The objects in the order of the technique: arranged when they are asked for, since kernels do without.
  const Geometry<Real>& arranged() const {
    if constexpr (OrdersObjects<A>) {
      std::call_once(arranging_, [&] { arranged_.emplace(given_.arranged(technique_.order())); });
      return *arranged_;
    } else {
      return given_;
    }
  }

  Naming name() const {
    if constexpr (OrdersObjects<A>)
      return {technique_.order().data()};
    else
      return {};
  }

  /// Call function(test) with the ray-object test that serves best.
  template <class Function>
  void with_test(const typename A::Scratch& scratch, const Function& function) const {
    if constexpr (TestsObjects<A>)
      function(technique_.object_test(scratch));
    else
      with_object_test(arranged(), function);
  }
  auto counted_test(const typename A::Scratch& scratch) const {
    if constexpr (TestsObjects<A>)
      return technique_.object_test(scratch);
    else
      return ObjectTest<Real>{arranged()};
  }

  /// The timed loops: everything below them is one function to the compiler.
  template <class Test>
  [[gnu::flatten, gnu::noinline]] void closest_of_all(const Test& test, std::span<const Ray<Real>> rays,
                                                      std::span<Hit<Real>> hits,
                                                      typename A::Scratch& scratch) const {
    for (std::size_t i = 0; i < rays.size(); ++i)
      hits[i] = closest_hit(technique_, test, name(), begun(rays[i]), scratch);
  }
  template <class Test>
  [[gnu::flatten, gnu::noinline]] void any_of_all(const Test& test, std::span<const Ray<Real>> rays,
                                                  std::span<std::uint8_t> blocked,
                                                  typename A::Scratch& scratch) const {
    for (std::size_t i = 0; i < rays.size(); ++i)
      blocked[i] = any_hit(technique_, test, name(), begun(rays[i]), scratch);
  }

  Hit<Real> counted_query(Query query, const Ray<Real>& given, Scratch& scratch, Work& work) const {
    const Ray<Real> ray = begun(given);
    const auto test = counted_test(scratch.technique);
    using Test = std::remove_const_t<decltype(test)>;
    if (query == Query::closest) {
      ClosestLeaf<Real, Test> leaf(test, name(), ray);
      counted_visit(technique_, ray, scratch.technique, work, leaf, scratch.candidates);
      return leaf.hit();
    }
    if (query == Query::any) {
      AnyLeaf<Real, Test> leaf(test, name(), ray);
      counted_visit(technique_, ray, scratch.technique, work, leaf, scratch.candidates);
      return leaf.blocked() ? Hit<Real>{0, 0} : Hit<Real>{};
    }
    StrictLeaf<Real, Test> leaf(test, name(), ray);
    counted_visit(technique_, ray, scratch.technique, work, leaf, scratch.candidates);
    return {};
  }

  A technique_;
  const Geometry<Real>& given_;
  mutable std::once_flag arranging_;
  mutable std::optional<Geometry<Real>> arranged_;
};

/// The registry entry of a technique written as a template over the scalar.
template <template <class> class A>
TechniqueEntry define_technique() {
  const auto engine = []<class Real>(const EngineInput<Real>& input) -> std::unique_ptr<Engine<Real>> {
    return std::make_unique<TechniqueEngine<A<Real>>>(input);
  };
  const auto optimizer = []<class Real>(const OptimizerInput<Real>& input,
                                        const Arguments& arguments) -> std::unique_ptr<Optimizer<Real>> {
    if constexpr (HasCells<A<Real>>)
      return std::make_unique<TechniqueIndex<A<Real>>>(input, arguments);
    else
      return std::make_unique<TechniqueOptimizer<A<Real>>>(input, arguments);
  };
  return {.info = A<float>::info(),
          .build_float = engine,
          .build_double = engine,
          .optimizer_float = optimizer,
          .optimizer_double = optimizer,
          .indexes_space = HasCells<A<float>>};
}

/// Registers the technique `TYPE<Real>` of the file `ID.cpp`.
#define RAYSHOOT_TECHNIQUE(ID, TYPE)                              \
  const TechniqueEntry& technique_##ID() {                        \
    static const TechniqueEntry entry = define_technique<TYPE>(); \
    return entry;                                                 \
  }

}  // namespace rayshoot
