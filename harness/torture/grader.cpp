#include "harness/torture/grader.h"

#include "accel/core/batch.h"
#include "harness/baseline/denormals.h"

namespace rayshoot {

namespace {

/// A ray on which a technique spends more work than this, and as much again for every object, has lost its way.
constexpr std::uint64_t kMostWork = 10'000, kMostWorkPerObject = 64;

/// Object tests to spend on finding all crossings of the rays of a cell exhaustively.
constexpr std::uint64_t kCrossingTests = 2'000'000;

/// A technique built over a scene. Where the cell says so, building and tracing take denormal numbers as zero, and
/// nothing else does.
template <class Real>
struct Standing {
  Geometry<Real> geometry;
  bool flush_to_zero;
  std::unique_ptr<Engine<Real>> engine;
  ThreadScratch<Real> scratch;

  Standing(const Scene& scene, const TortureCell& cell)
      : geometry(scene, ConeSides::both, cell.intersector),
        flush_to_zero(cell.flush_to_zero),
        engine(built(geometry, cell)),
        scratch(*engine) {}

  static std::unique_ptr<Engine<Real>> built(const Geometry<Real>& geometry, const TortureCell& cell) {
    const FlushToZero flush(cell.flush_to_zero);
    return cell.technique->entry->build<Real>({geometry, cell.technique->arguments});
  }

  std::vector<Hit<Real>> closest(std::span<const Ray<Real>> rays, int threads = 1) {
    std::vector<Hit<Real>> hits(rays.size());
    const FlushToZero flush(flush_to_zero);
    trace_closest<Real>(*engine, rays, hits, scratch, threads);
    return hits;
  }

  std::vector<std::uint8_t> any(std::span<const Ray<Real>> rays) {
    std::vector<std::uint8_t> blocked(rays.size());
    const FlushToZero flush(flush_to_zero);
    trace_any<Real>(*engine, rays, blocked, scratch, 1);
    return blocked;
  }
};

template <class Real>
Ray<Real> in_precision(const Ray<double>& ray) {
  const auto limited = [](double t) {
    return t >= std::numeric_limits<double>::max() ? std::numeric_limits<Real>::max() : static_cast<Real>(t);
  };
  return {Vec3<Real>(ray.origin), static_cast<Real>(ray.t_min), Vec3<Real>(ray.direction),
          limited(ray.t_max)};
}

template <class Real>
std::vector<Ray<Real>> rays_of(const StiffSetting& setting, std::uint64_t seed, std::uint64_t first,
                               std::uint64_t count) {
  std::vector<Ray<double>> rays(count);
  setting.rays(seed, first, rays);
  std::vector<Ray<Real>> result;
  result.reserve(count);
  for (const Ray<double>& ray : rays) result.push_back(in_precision<Real>(ray));
  return result;
}

template <class Real>
class Grader {
 public:
  Grader(const TortureCell& cell, Tally& tally)
      : cell_(cell), tally_(tally), stressed_(scene_of(cell), cell) {
    if (cell.of_setting().property == Property::same_as_base) base_.emplace(*cell.base()->scene, cell);
    tally_.objects = stressed_.geometry.size();
    tally_.set_aside = stressed_.geometry.set_aside().size();
    tally_.built = true;
    stressed_.geometry.require_objects(scene_of(cell).id);
  }

  void batch(std::uint64_t first, std::uint64_t count) {
    const std::vector<Ray<Real>> rays = rays_of<Real>(cell_.of_setting(), cell_.seed, first, count);
    const std::vector<Hit<Real>> hits = stressed_.closest(rays);
    Tally next = tally_;
    hold_to_promise(rays, hits, first, next);
    if (first < cell_.graded_rays) {
      const std::uint64_t graded = std::min(count, cell_.graded_rays - first);
      hold_to_itself(std::span(rays).first(graded), std::span(hits).first(graded), first, next);
      hold_to_oracle(std::span(rays).first(graded), std::span(hits).first(graded), next);
      count_work(std::span(rays).first(graded), next);
      look_for_crossings(std::span(rays).first(graded), next);
    }
    next.rays = first + count;
    next.pulse = tally_.pulse + 1;
    tally_ = next;
  }

 private:
  static const Scene& scene_of(const TortureCell& cell) { return *cell.of_setting().scene; }

  void hold_to_promise(const std::vector<Ray<Real>>& rays, const std::vector<Hit<Real>>& hits,
                       std::uint64_t first, Tally& tally) {
    const StiffSetting& setting = cell_.of_setting();
    const auto missed = [](const Hit<Real>& hit) { return hit.object == kNoObject; };
    const auto misses = static_cast<std::uint64_t>(std::count_if(hits.begin(), hits.end(), missed));
    if (setting.property == Property::always_hit) tally.leaks += misses;
    if (setting.property == Property::never_hit) tally.forbidden_hits += hits.size() - misses;
    if (!base_) return;
    const auto base_hits = base_->closest(rays_of<Real>(*cell_.base(), cell_.seed, first, rays.size()));
    for (std::size_t i = 0; i < hits.size(); ++i) {
      const auto t = missed(base_hits[i]) ? kMiss<Real> : static_cast<Real>(base_hits[i].t * setting.t_scale);
      tally.changed += hits[i] != Hit<Real>{t, base_hits[i].object};
    }
  }

  /// The any-hit query says whether there is a nearest hit; more threads say the same.
  void hold_to_itself(std::span<const Ray<Real>> rays, std::span<const Hit<Real>> hits, std::uint64_t first,
                      Tally& tally) {
    const std::vector<std::uint8_t> blocked = stressed_.any(rays);
    for (std::size_t i = 0; i < hits.size(); ++i)
      tally.any_differs += (blocked[i] != 0) != (hits[i].object != kNoObject);
    // Other threads know nothing of this one's treatment of denormal numbers.
    if (first > 0 || rays.size() < 2 || cell_.flush_to_zero) return;
    for (const int threads : {2, 4}) {
      const std::vector<Hit<Real>> together = stressed_.closest(rays, threads);
      for (std::size_t i = 0; i < hits.size(); ++i) tally.threads_differ += together[i] != hits[i];
    }
  }

  void hold_to_oracle(std::span<const Ray<Real>> rays, std::span<const Hit<Real>> hits, Tally& tally) {
    if (!oracle_) oracle_.emplace(stressed_.geometry);
    for (std::size_t i = 0; i < rays.size(); ++i) {
      tally.grades.add(oracle_->grade(rays[i], hits[i]), hits[i].object != kNoObject);
      ++tally_.pulse;
    }
  }

  void count_work(std::span<const Ray<Real>> rays, Tally& tally) {
    if (!stressed_.engine->countable()) return;
    const std::uint64_t bound = kMostWork + kMostWorkPerObject * tally.objects;
    for (const Ray<Real>& ray : rays) {
      Hit<Real> hit;
      const Work work =
          stressed_.engine->count(Query::closest, {&ray, 1}, {&hit, 1}, stressed_.scratch.local()).total;
      tally.work += work;
      tally.most_steps = std::max(tally.most_steps, work.steps);
      tally.grades[AnswerClass::over_steps] += work.steps + work.object_tests + work.volume_tests > bound;
    }
  }

  /// Every object that a ray crosses is among the candidates of the strict optimizer, equation (10): an algebra of
  /// solids and the parity of crossings rest on that.
  void look_for_crossings(std::span<const Ray<Real>> rays, Tally& tally) {
    if (!stressed_.engine->countable()) return;
    const Geometry<Real>& geometry = stressed_.geometry;
    for (const Ray<Real>& ray : rays) {
      if ((tally.crossed_rays + 1) * geometry.size() > kCrossingTests) return;
      const auto candidates = stressed_.engine->candidates(Query::strict, ray, stressed_.scratch.local());
      for (std::uint32_t object = 0; object < geometry.size(); ++object)
        tally.crossings_lost += geometry.hit_distance(object, ray) != kMiss<Real> &&
                                !std::binary_search(candidates.begin(), candidates.end(), object);
      ++tally.crossed_rays, ++tally.pulse;
    }
  }

  const TortureCell& cell_;
  Tally& tally_;
  Standing<Real> stressed_;
  std::optional<Standing<Real>> base_;
  std::optional<ExactOracle<Real>> oracle_;
};

template <class Real>
void grade_in(const TortureCell& cell, Tally& tally, std::uint64_t end, std::uint64_t at_once) {
  Grader<Real> grader(cell, tally);
  while (tally.rays < end) grader.batch(tally.rays, std::min(at_once, end - tally.rays));
}

}  // namespace

void grade(const TortureCell& cell, Tally& tally, std::uint64_t end, std::uint64_t at_once) {
  if (cell.scalar == "float")
    grade_in<float>(cell, tally, end, at_once);
  else
    grade_in<double>(cell, tally, end, at_once);
}

}  // namespace rayshoot
