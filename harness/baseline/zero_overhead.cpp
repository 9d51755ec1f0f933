// Zero overhead (Jevans 1990, section 7)
//
// Idea       Replay hits that are already known: one ray-object test for each ray that hits something, none
// for
//            a ray that misses. No technique can do with less, so its time is the limit for all others.
// Parameters none; it needs the recorded nearest hits of the very rays that it is given.
// Cost       the share of rays that hit, in ray-object tests per ray; M is that share over n.
// Weak       as a limit: its memory accesses do not depend on one another, so that a processor overlaps their
//            latencies as no search can.

#include <stdexcept>

#include "accel/core/queries.h"
#include "harness/baseline/baselines.h"

namespace rayshoot {

namespace {

template <class Real>
class ZeroOverhead final : public Engine<Real> {
 public:
  explicit ZeroOverhead(const EngineInput<Real>& input) : geometry_(input.geometry) {
    if (input.recorded == nullptr) throw InputError("zero_overhead needs the recorded hits of its rays");
    recorded_ = *input.recorded;
  }

  std::unique_ptr<EngineScratch> scratch() const override { return std::make_unique<EngineScratch>(); }

  void closest(std::span<const Ray<Real>> rays, std::span<Hit<Real>> hits, EngineScratch&) const override {
    with_test([&](const auto& test) { replay(test, rays, recorded(rays), hits); });
  }

  void any(std::span<const Ray<Real>> rays, std::span<std::uint8_t> blocked, EngineScratch&) const override {
    with_test([&](const auto& test) { replay(test, rays, recorded(rays), blocked); });
  }

  /// The strict query hands out the nearest hit as well: nothing but that is known.
  CountedWork count(Query query, std::span<const Ray<Real>> rays, std::span<Hit<Real>> hits,
                    EngineScratch& scratch) const override {
    if (query != Query::strict) closest(rays, hits, scratch);
    CountedWork sum;
    for (const Hit<Real>& hit : recorded(rays)) {
      const std::uint64_t tests = hit.object != kNoObject;
      const auto square = static_cast<double>(tests);
      sum += {{.rays = 1, .object_tests = tests, .distinct_objects = tests}, square, square, 0};
    }
    return sum;
  }

  std::vector<std::uint32_t> candidates(Query, const Ray<Real>& ray, EngineScratch&) const override {
    const std::uint32_t object = recorded({&ray, 1}).front().object;
    if (object == kNoObject) return {};
    return {object};
  }

  StructureStats structure() const override { return {}; }

 private:
  /// Hits tell objects by number: where parts are placed, the object has to be found.
  template <class Function>
  void with_test(const Function& function) const {
    if (!geometry_.has_placed()) return with_object_test(geometry_, function);
    function([this](std::uint32_t number, const Ray<Real>& ray) {
      return geometry_.hit_distance_of_number(number, ray);
    });
  }

  /// The hits of rays that are a part of the recorded ones, told by where they lie in memory.
  std::span<const Hit<Real>> recorded(std::span<const Ray<Real>> rays) const {
    const std::less_equal<const Ray<Real>*> not_behind;
    const Ray<Real>* const first = recorded_.rays.data();
    if (!not_behind(first, rays.data()) ||
        !not_behind(rays.data() + rays.size(), first + recorded_.rays.size()))
      throw std::logic_error("zero_overhead can replay no other rays than the recorded ones");
    return recorded_.hits.subspan(static_cast<std::size_t>(rays.data() - first), rays.size());
  }

  /// Jevans' "zero overhead" algorithm: test the object that each ray is known to hit, if any.
  template <class Test, class Answer>
  [[gnu::flatten, gnu::noinline]] static void replay(const Test& test, std::span<const Ray<Real>> rays,
                                                     std::span<const Hit<Real>> known,
                                                     std::span<Answer> answers) {
    for (std::size_t i = 0; i < rays.size(); ++i) {
      Hit<Real> hit;
      if (const std::uint32_t object = known[i].object; object != kNoObject) {
        const Real t = test(object, rays[i]);
        if (t <= rays[i].t_max) hit = {t, object};
      }
      if constexpr (std::is_same_v<Answer, Hit<Real>>)
        answers[i] = hit;
      else
        answers[i] = hit.object != kNoObject;
    }
  }

  const Geometry<Real>& geometry_;
  RecordedHits<Real> recorded_;
};

template <class Real>
std::unique_ptr<Engine<Real>> build(const EngineInput<Real>& input) {
  return std::make_unique<ZeroOverhead<Real>>(input);
}

}  // namespace

const TechniqueEntry& baseline_zero_overhead() {
  static const TechniqueEntry entry{.info = {.id = "zero_overhead",
                                             .title = "Zero overhead: replays recorded nearest hits",
                                             .family = "baseline",
                                             .survey_section = "",
                                             .paper = "Jevans 1990, section 7",
                                             .parameters = {},
                                             .needs_recorded_hits = true,
                                             .baseline = true},
                                    .build_float = build<float>,
                                    .build_double = build<double>,
                                    .builds_parts = true};
  return entry;
}

}  // namespace rayshoot
