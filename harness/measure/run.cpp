#include "harness/measure/run.h"

#include <fmt/format.h>

#include <algorithm>
#include <deque>
#include <thread>

#include "harness/measure/building.h"
#include "harness/measure/enough_rays.h"
#include "harness/measure/environment.h"
#include "harness/measure/group.h"
#include "harness/verify/scene_tracer.h"
#include "scenes/core/needs.h"
#include "scenes/core/stiffness.h"
#include "scenes/io/load_scene.h"

namespace rayshoot {

namespace {

report::Bounds record(const Box<double>& box) {
  return {{box.lo.x, box.lo.y, box.lo.z}, {box.hi.x, box.hi.y, box.hi.z}};
}

report::Scene record(const LoadedScene& loaded, Phases& phases) {
  const Scene& scene = loaded.scene;
  report::Scene result{.id = scene.id,
                       .generator = loaded.generator,
                       .size = loaded.size,
                       .form = loaded.form,
                       .objects = scene.numbers(),
                       .stiffness = stiffness(scene)};
  {
    const auto hashing = phases.scope(Phase::hash);
    result.hash = scene_hash(scene);
  }
  for (std::size_t kind = 0; kind < kObjectKindNames.size(); ++kind)
    result.counts[kObjectKindNames[kind]] = scene.counts()[kind];
  if (const Box<double> bounds = scene.bounds(); !bounds.empty()) result.bounds = record(bounds);
  const SceneNeeds needs = needs_of(scene);
  result.needs = {{"shadow_rays", needs.shadow_rays},
                  {"reflected_rays", needs.reflected_rays},
                  {"refracted_rays", needs.refracted_rays},
                  {"curved_objects", needs.curved_objects},
                  {"triangles_only", needs.triangles_only},
                  {"placed_parts", needs.placed_parts},
                  {"motion", needs.motion}};
  for (const LeftOut& line : left_out(needs)) result.left_out.push_back({line.what, line.why});
  if (needs.placed_parts)
    result.left_out.push_back(
        {"grading against exact arithmetic", "rays are rounded on their way into placed parts"});
  return result;
}

report::RaySet record(const RaySet& set, const std::string& scene, Phases& phases) {
  const auto hashing = phases.scope(Phase::hash);
  return {.id = fmt::format("{}/{}", scene, set.id),
          .scene = scene,
          .distribution = set.distribution,
          .rules = set.rules.empty() ? std::nullopt : std::optional(set.rules),
          .rays = set.rays.size(),
          .closest_rays = set.closest_rays,
          .any_rays = set.rays.size() - set.closest_rays,
          .primary_rays = set.counts.primary_rays,
          .primary_hits = set.counts.primary_hits,
          .shadow_rays = set.counts.shadow_rays,
          .shadow_hits = set.counts.shadow_hits,
          .reflected_rays = set.counts.reflected_rays,
          .refracted_rays = set.counts.refracted_rays,
          .total_internal_reflections = set.counts.total_internal_reflections,
          .secondary_hits = set.counts.secondary_hits,
          .hash = set.hash()};
}

/// One scene after the other; of each, rays first and then its groups of cells.
class Runner {
 public:
  Runner(const Plan& plan, report::Report& report, Phases& phases, RunObserver& observer,
         const std::function<bool()>& stopped)
      : plan_(plan), report_(report), phases_(phases), observer_(observer), stopped_(stopped) {}

  void run_scene(const std::string& spec) {
    observer_.doing("loading " + spec);
    const LoadedScene loaded = load(spec);
    report_.scenes.push_back(record(loaded, phases_));
    const std::vector<PreparedRays> rays = prepare(loaded.scene);
    for (const ConeSides sides : {ConeSides::both, ConeSides::outside})
      for (const std::string& scalar : plan_.suite.scalars)
        for (const std::string& intersector : plan_.suite.intersectors)
          run_group({plan_, phases_, loaded.scene, sides, scalar, intersector, {}}, rays);
  }

 private:
  LoadedScene load(const std::string& spec) {
    const auto generating = phases_.scope(Phase::generate);
    return load_scene(spec);
  }

  /// Generate all rays that the scene can have.
  std::vector<PreparedRays> prepare(const Scene& scene) {
    const auto shooting = phases_.scope(Phase::rays);
    std::vector<PreparedRays> prepared;
    std::map<ConeSides, SceneTracer> tracers;
    for (const RaySpec& spec : plan_.rays) {
      if (stopped_()) break;
      observer_.doing(fmt::format("{}: shooting {}", scene.id, spec.id));
      PreparedRays& rays = prepared.emplace_back(PreparedRays{&spec, {.id = spec.id}});
      if (!why_left_out(spec, scene).empty()) continue;
      const Tracer& tracer =
          tracers.try_emplace(spec.cone_sides(), scene, spec.cone_sides(), threads_).first->second.tracer();
      if (plan_.suite.target_m_error > 0) {
        observer_.doing(fmt::format("{}: how many rays of {} M needs", scene.id, spec.distribution->id));
        rays.spec = &enough_.emplace_back(enough_rays(plan_, spec, scene, tracer, threads_, stopped_));
      }
      rays.set = make_rays(*rays.spec, scene, tracer, plan_.suite.seed);
      report_.ray_sets.push_back(record(rays.set, scene.id, phases_));
    }
    return prepared;
  }

  void run_group(GroupInput group, const std::vector<PreparedRays>& rays) {
    for (const PreparedRays& one : rays)
      if (one.spec->cone_sides() == group.cone_sides) group.rays.push_back(&one);
    if (group.rays.empty() || stopped_()) return;
    record_left_out(group);
    if (group.scalar == "float")
      rayshoot::run_group<float>(group, report_, observer_, stopped_);
    else
      rayshoot::run_group<double>(group, report_, observer_, stopped_);
  }

  void record_left_out(const GroupInput& group) {
    std::size_t count = 0;
    for (const PreparedRays* rays : group.rays)
      for (const TechniqueChoice& technique : plan_.techniques) {
        if (!is_planned(technique, group.scene.id)) continue;
        const std::string why = why_left_out(plan_.suite, {group.scene, *rays->spec, rays->set.rays.size(),
                                                           technique, group.scalar, group.intersector});
        if (why.empty()) continue;
        report_.left_out.push_back({group.scene.id, fmt::format("{}/{}", group.scene.id, rays->set.id),
                                    technique.spec, group.scalar, group.intersector, why});
        ++count;
      }
    observer_.finished(count);
  }

  const Plan& plan_;
  report::Report& report_;
  Phases& phases_;
  RunObserver& observer_;
  const std::function<bool()>& stopped_;
  int threads_ = static_cast<int>(std::max(1u, std::thread::hardware_concurrency()));
  /// Rays in the numbers that M needs; they stay where they are.
  std::deque<RaySpec> enough_;
};

}  // namespace

report::Report run(const Plan& plan, report::Run run, RunObserver& observer,
                   const std::function<bool()>& stopped) {
  report::Report report{.run = std::move(run), .environment = environment()};
  report.run.bounds = kBoundsRuleNames[static_cast<std::size_t>(plan.suite.bounds)];
  if (!plan.suite.published.empty()) report.run.published = plan.published.source;
  Phases phases;
  Runner runner(plan, report, phases, observer, stopped);
  report.run.seconds = seconds_of([&] {
    for (const std::string& scene : plan.suite.scenes) {
      if (!stopped()) runner.run_scene(scene);
      if (!stopped()) observer.scene_done(report);
    }
  });
  report.run.phase_seconds = phases.seconds();
  report.run.complete = !stopped();
  return report;
}

}  // namespace rayshoot
