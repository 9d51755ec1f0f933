// Techniques in scenes of placed parts (Snyder & Barr 1987; Kirk & Arvo 1988; Arvo & Kirk §12)
//
// Idea       A scene may be an object of another scene, so a technique may be an object of another technique. Each part gets an
//            optimizer of its own, once, however often the part is placed. Where a ray's candidate is a placed part, the ray
//            is taken into the part's coordinates, at its time, and the optimizer there goes on.
// Cost       That of the optimizer around, and for each placed part on the ray that of the one inside, and a ray to map.
// Weak       where boxes of placed parts overlap much: each of them is entered.
//
// Exactness  A hit in a part counts while the ray is inside the box of the placed part, at every depth. So an optimizer may leave
//            out a part by its box and changes no answer. Distances are the same in all coordinates.

#include "accel/algebra/in_parts.h"

#include "accel/algebra/composed.h"
#include "accel/core/define_technique.h"
#include "accel/core/registry.h"

namespace rayshoot {

namespace {

template <class Real>
class InParts {
 public:
  using Scalar = Real;

  /// Where a candidate is tested: the visit that hands it on is in this part.
  struct Place {
    const Geometry<Real>* geometry = nullptr;
    const Ray<Real>* ray = nullptr;
    Interval<Real> interval{};
    std::uint32_t object = 0;
  };
  struct Scratch {
    std::vector<typename Composed<Real>::Scratch> levels;
    Place place{};
    bool ended = false;
  };

  InParts(const EngineInput<Real>& input, const BuildLevel<Real>& build, bool composed) {
    std::unordered_map<const Geometry<Real>*, std::uint32_t> numbers;
    const auto add = [&](const Geometry<Real>& geometry, const OptimizerInput<Real>& scene, bool whole) {
      const std::vector<Placed<Real>>& placed = placements_of(geometry);
      std::vector<std::uint32_t> parts;
      for (const Placed<Real>& part : placed) parts.push_back(numbers.at(part.part.get()));
      numbers.emplace(&geometry, static_cast<std::uint32_t>(levels_.size()));
      levels_.push_back(
          {&geometry, Composed<Real>(build(scene, whole), geometry.size(), composed), std::move(parts)});
    };
    for (const Geometry<Real>* part : input.geometry.distinct_parts()) add(*part, {*part, {}, {}}, false);
    add(input.geometry, {input.geometry, {}, input.sample}, true);
  }

  Scratch scratch() const {
    Scratch scratch;
    for (const Level& level : levels_) scratch.levels.push_back(level.optimizer.scratch());
    return scratch;
  }

  template <class Counter, class L>
  void visit(const Ray<Real>& ray, Scratch& scratch, Counter count, L& leaf) const {
    scratch.ended = false;
    constexpr Real infinity = std::numeric_limits<Real>::infinity();
    Inside<Counter, L> whole{*this, levels_.back(), ray, {-infinity, infinity}, 0, scratch, count, leaf};
    visit_level(static_cast<std::uint32_t>(levels_.size() - 1), ray, whole);
  }

  /// The ray-object test of the candidate that the visit has just handed on.
  auto object_test(const Scratch& scratch) const {
    return [&place = scratch.place](std::uint32_t, const Ray<Real>&) {
      const Real t = place.geometry->hit_distance(place.object, *place.ray);
      return counts_within(t, place.interval) ? t : kMiss<Real>;
    };
  }

  StructureStats structure() const {
    StructureStats stats;
    for (const Level& level : levels_) stats += level.optimizer.structure();
    stats.figures = {{"parts", static_cast<double>(levels_.size() - 1)}};
    return stats;
  }

 private:
  /// A part, or the whole scene, which is the last.
  struct Level {
    const Geometry<Real>* geometry;
    Composed<Real> optimizer;
    /// The levels of what is placed in it.
    std::vector<std::uint32_t> parts;
  };

  /// Takes the candidates of a level for a ray in its coordinates.
  template <class Counter, class L>
  struct Inside {
    const InParts& all;
    const Level& level;
    const Ray<Real>& ray;
    /// Where hits count.
    Interval<Real> interval;
    /// The number of the level's first object.
    std::uint32_t first;
    Scratch& scratch;
    Counter count;
    L& leaf;

    bool operator()(std::uint32_t object) {
      if (level.geometry->kind(object) == ObjectKind::placed) return enter(object);
      scratch.place = {level.geometry, &ray, interval, object};
      return scratch.ended = leaf(first + level.geometry->first_number(object));
    }
    Real reach() const { return std::min<Real>(leaf.reach(), interval.exit); }

    /// Go on inside of a placed part whose box the ray meets.
    bool enter(std::uint32_t object) {
      const Placed<Real>& placed = level.geometry->placed(object);
      count.volume_tests();
      const Interval<Real> box = placed.interval(ray);
      const Interval<Real> common{std::max(interval.enter, box.enter), std::min(interval.exit, box.exit)};
      if (!(common.enter <= common.exit) || common.exit < ray.t_min || common.enter > leaf.reach())
        return false;
      Ray<Real> within = placed.inside(ray);
      within.t_max = leaf.reach();
      if (!is_finite(within.origin) || !is_finite(within.direction)) return false;
      const std::uint32_t part = level.parts[level.geometry->index(object)];
      Inside deeper{all,
                    all.levels_[part],
                    within,
                    common,
                    first + level.geometry->first_number(object),
                    scratch,
                    count,
                    leaf};
      all.visit_level(part, within, deeper);
      return scratch.ended;
    }
  };

  template <class Counter, class L>
  void visit_level(std::uint32_t level, const Ray<Real>& ray, Inside<Counter, L>& inside) const {
    levels_[level].optimizer.visit(ray, inside.scratch.levels[level], inside.count, inside);
  }

  std::vector<Level> levels_;
};

}  // namespace

template <class Real>
std::unique_ptr<Engine<Real>> engine_in_parts(const EngineInput<Real>& input, const BuildLevel<Real>& build,
                                              bool composed) {
  return std::make_unique<TechniqueEngine<InParts<Real>>>(InParts<Real>(input, build, composed),
                                                          input.geometry);
}

template std::unique_ptr<Engine<float>> engine_in_parts(const EngineInput<float>&, const BuildLevel<float>&,
                                                        bool);
template std::unique_ptr<Engine<double>> engine_in_parts(const EngineInput<double>&,
                                                         const BuildLevel<double>&, bool);

template <class Real>
std::unique_ptr<Engine<Real>> TechniqueEntry::build_in_parts(const EngineInput<Real>& input) const {
  if (!composable()) throw InputError(info.id + " does not search placed parts");
  const BuildLevel<Real> level = [&](const OptimizerInput<Real>& scene, bool) {
    return build_optimizer<Real>(scene, input.arguments);
  };
  return engine_in_parts(input, level, composed);
}

template std::unique_ptr<Engine<float>> TechniqueEntry::build_in_parts(const EngineInput<float>&) const;
template std::unique_ptr<Engine<double>> TechniqueEntry::build_in_parts(const EngineInput<double>&) const;

}  // namespace rayshoot
