#include "harness/choose/choose.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <thread>

#include "analysis/statistics/sample.h"
#include "harness/choose/candidates.h"
#include "harness/choose/prune.h"
#include "harness/choose/race.h"
#include "harness/choose/sample.h"
#include "harness/choose/terms.h"
#include "harness/measure/building.h"
#include "harness/measure/record.h"
#include "harness/verify/scene_tracer.h"
#include "scenes/io/load_scene.h"

namespace rayshoot {

namespace {

/// Rays on which candidates are counted, and rays that they race on, in runs of neighbours as long as a bundle of rays that
/// share what is in the caches.
constexpr std::size_t kCountedRays = 2000, kRacedRays = 16'384, kNeighbours = 64;
/// Candidates whose expected cost is at most this many times the least are near ties; so many of them race.
constexpr double kNearTie = 1.6;
constexpr std::size_t kMostInRace = 6;

/// A combination of scene, rays, scalar and intersector for which a technique is wanted.
struct Question {
  const Plan& plan;
  const Scene& scene;
  const RaySpec& spec;
  const RaySet& rays;
  const std::string& scalar;
  const std::string& intersector;
};

/// A candidate that was built and counted.
template <class Real>
struct Weighed {
  report::Candidate record;
  Built<Real> built;
  /// Nanoseconds that a ray is expected to cost, with its share of the build; infinite where nothing is expected.
  double cost = std::numeric_limits<double>::infinity();
};

template <class Real>
class Chooser {
 public:
  Chooser(const Question& question, const Candidates& candidates, const ChooserOptions& options,
          const Constants& constants, const std::function<bool()>& stopped)
      : question_(question),
        candidates_(candidates),
        options_(options),
        constants_(constants),
        stopped_(stopped),
        geometry_(question.scene, question.spec.cone_sides(), intersector_named(question.intersector),
                  question.plan.suite.bounds),
        statistics_(statistics_of(geometry_)) {}

  report::Choice choose() {
    geometry_.require_objects(question_.scene.id);
    begin();
    choice_.seconds = seconds_of([&] {
      weigh_all();
      if (stopped_()) return;
      require_some();
      std::stable_sort(weighed_.begin(), weighed_.end(),
                       [](const auto& a, const auto& b) { return a.cost < b.cost; });
      choice_.predicted = choice_.pick = weighed_.front().record.spec;
      choice_.why = expectation();
      if (options_.race) race_near_ties();
    });
    for (Weighed<Real>& one : weighed_) choice_.candidates.push_back(std::move(one.record));
    return std::move(choice_);
  }

 private:
  void begin() {
    choice_ = {.scene = question_.scene.id,
               .rays = fmt::format("{}/{}", question_.scene.id, question_.rays.id),
               .scalar = question_.scalar,
               .intersector = question_.intersector,
               .statistics = statistics_.by_name(),
               .constants = constants_.origin(),
               .fitted = std::find(constants_.scenes.begin(), constants_.scenes.end(), question_.scene.id) !=
                         constants_.scenes.end(),
               .expected_rays = options_.expected_rays};
  }

  /// Why a candidate is not built; empty where it is.
  std::string objection(const TechniqueChoice& candidate) const {
    const std::string why =
        why_left_out(question_.plan.suite, {question_.scene, question_.spec, question_.rays.rays.size(),
                                            candidate, question_.scalar, question_.intersector});
    return why.empty() && !candidates_.named ? why_not_weighed(candidate, statistics_, constants_) : why;
  }

  /// Leave out what the scene does not need, build the others and count what they do for a few rays.
  void weigh_all() {
    const Batch<Real> sample(stratified(question_.rays, kCountedRays, 1, question_.plan.suite.seed));
    choice_.sample_rays = sample.rays.size();
    const std::vector<Ray<Real>> rays = sampled<Real>({&question_.rays});
    const RaySample<Real> shown{rays, static_cast<double>(question_.rays.rays.size()) /
                                          std::max(1.0, static_cast<double>(rays.size()))};
    for (const TechniqueChoice& candidate : candidates_.techniques) {
      if (stopped_()) return;
      std::string why = objection(candidate);
      if (why.empty()) why = weigh(candidate, sample, shown);
      if (!why.empty()) choice_.left_out.push_back({candidate.spec, why});
    }
  }

  /// Build and count a candidate; why that could not be done, or nothing.
  std::string weigh(const TechniqueChoice& candidate, const Batch<Real>& sample,
                    const RaySample<Real>& shown) {
    Weighed<Real> one{.record = {.spec = candidate.spec,
                                 .technique = candidate.entry->info.id,
                                 .config = config_of(candidate.arguments)},
                      .built = build_once<Real>(candidate, geometry_, nullptr, shown)};
    if (!one.built.engine) return one.built.failure;
    one.record.build_ns = one.built.build_ns.front();
    one.record.counts = terms_of(*one.built.engine, geometry_, sample);
    if (const TechniqueConstants* known = constants_.find(one.record.technique)) {
      one.record.predicted_ns_per_ray = constants_.predicted_ns(*known, one.record.counts);
      one.cost = *one.record.predicted_ns_per_ray + build_share(one);
    }
    weighed_.push_back(std::move(one));
    return {};
  }

  double build_share(const Weighed<Real>& one) const {
    return options_.expected_rays ? one.record.build_ns / *options_.expected_rays : 0;
  }

  void require_some() const {
    if (weighed_.empty())
      throw InputError(fmt::format("{}: nothing is left to choose; {} is left out: {}", question_.scene.id,
                                   choice_.left_out.front().what, choice_.left_out.front().why));
    if (!options_.race && std::isinf(weighed_.front().cost) &&
        std::all_of(weighed_.begin(), weighed_.end(), [](const auto& one) { return std::isinf(one.cost); }))
      throw InputError(
          fmt::format("no constants were fitted for {}: without a race there is nothing to choose by",
                      weighed_.front().record.spec));
  }

  std::string expectation() const {
    const Weighed<Real>& first = weighed_.front();
    if (weighed_.size() == 1) return fmt::format("{} is the only candidate left", first.record.spec);
    if (std::isinf(first.cost)) return "no constants were fitted for any candidate";
    std::string text = fmt::format("{} is expected to cost {:.3g} ns a ray, the least of {} candidates",
                                   first.record.spec, first.cost, weighed_.size());
    if (!std::isinf(weighed_[1].cost))
      text += fmt::format("; {} follows with {:.3g}", weighed_[1].record.spec, weighed_[1].cost);
    return text;
  }

  /// Those whose expected cost is near the least, and those of which nothing is expected.
  std::vector<Weighed<Real>*> near_ties() {
    std::vector<Weighed<Real>*> near;
    for (Weighed<Real>& one : weighed_)
      if (std::isinf(one.cost) || (one.cost <= kNearTie * weighed_.front().cost && near.size() < kMostInRace))
        near.push_back(&one);
    return near;
  }

  /// Time near ties. The fastest takes the choice from the cheapest by prediction where the interval of the ratio of their
  /// paired times says that it is faster.
  void race_near_ties() {
    const std::vector<Weighed<Real>*> near = near_ties();
    if (near.size() < 2) return;
    const Batch<Real> sample(stratified(question_.rays, kRacedRays, kNeighbours, question_.plan.suite.seed));
    std::vector<const Engine<Real>*> engines;
    for (const Weighed<Real>* one : near) engines.push_back(one->built.engine.get());
    auto times = race(engines, sample, question_.plan.suite.threads, stopped_);
    if (stopped_()) return;

    std::vector<double> medians;
    for (std::size_t i = 0; i < near.size(); ++i) {
      near[i]->record.race_ns_per_ray = times[i];
      for (double& ns : times[i]) ns += build_share(*near[i]);
      medians.push_back(analysis::median(times[i])->value);
    }
    const auto fastest =
        static_cast<std::size_t>(std::min_element(medians.begin(), medians.end()) - medians.begin());
    const auto lead = analysis::ratio(times[0], times[fastest]);
    decide(near, medians, fastest, lead && lead->interval && lead->interval->low > 1);
  }

  void decide(const std::vector<Weighed<Real>*>& near, const std::vector<double>& medians,
              std::size_t fastest, bool faster) {
    std::vector<std::string> standings;
    for (std::size_t i = 0; i < near.size(); ++i)
      standings.push_back(fmt::format("{} {:.3g}", near[i]->record.spec, medians[i]));
    const std::string& winner = near[fastest]->record.spec;
    choice_.why += fmt::format("; in a race of near ties, ns a ray: {}; ", fmt::join(standings, ", "));
    if (faster) choice_.pick = winner;
    if (faster)
      choice_.why += fmt::format("{} is faster", winner);
    else if (fastest == 0)
      choice_.why += fmt::format("{} stays first", winner);
    else
      choice_.why += fmt::format("{} is not faster than {} for certain", winner, choice_.pick);
  }

  const Question& question_;
  const Candidates& candidates_;
  const ChooserOptions& options_;
  const Constants& constants_;
  const std::function<bool()>& stopped_;
  Geometry<Real> geometry_;
  SceneStatistics statistics_;
  report::Choice choice_;
  std::vector<Weighed<Real>> weighed_;
};

report::Choice answer(const Question& question, const Candidates& candidates, const ChooserOptions& options,
                      const Constants& constants, const std::function<bool()>& stopped) {
  if (question.scalar == "float")
    return Chooser<float>(question, candidates, options, constants, stopped).choose();
  return Chooser<double>(question, candidates, options, constants, stopped).choose();
}

}  // namespace

std::vector<report::Choice> choose_techniques(const Plan& plan, const ChooserOptions& options,
                                              const Constants& constants, RunObserver& observer,
                                              const std::function<bool()>& stopped) {
  const int threads = static_cast<int>(std::max(1u, std::thread::hardware_concurrency()));
  const Candidates candidates = candidates_of(options.candidates, constants);
  std::vector<report::Choice> choices;
  for (const std::string& id : plan.suite.scenes) {
    observer.doing("loading " + id);
    const Scene scene = load_scene(id).scene;
    for (const RaySpec& spec : plan.rays) {
      if (!why_left_out(spec, scene).empty()) continue;
      observer.doing(fmt::format("{}: shooting {}", id, spec.id));
      const RaySet rays =
          make_rays(spec, scene, SceneTracer(scene, spec.cone_sides(), threads).tracer(), plan.suite.seed);
      for (const std::string& scalar : plan.suite.scalars)
        for (const std::string& intersector : plan.suite.intersectors) {
          if (stopped()) return choices;
          observer.doing(fmt::format("{} {}: choosing", id, spec.id));
          report::Choice choice =
              answer({plan, scene, spec, rays, scalar, intersector}, candidates, options, constants, stopped);
          if (!stopped()) choices.push_back(std::move(choice));
          observer.finished(1);
        }
    }
  }
  return choices;
}

void plan_choices(Plan& plan, const std::vector<report::Choice>& choices, bool all) {
  const auto add = [&plan](const std::string& spec, const std::string& scene) {
    const auto same = [&](const TechniqueChoice& technique) { return technique.spec == spec; };
    auto found = std::find_if(plan.techniques.begin(), plan.techniques.end(), same);
    if (found == plan.techniques.end()) {
      plan.techniques.push_back(choose_technique(spec));
      plan.techniques.back().scenes = {scene};
    } else if (!is_planned(*found, scene)) {
      found->scenes.push_back(scene);
    }
  };
  for (const report::Choice& choice : choices) {
    add(choice.pick, choice.scene);
    for (const report::Candidate& candidate : choice.candidates)
      if (all) add(candidate.spec, choice.scene);
  }
}

}  // namespace rayshoot
