#include "harness/measure/group.h"

#include <fmt/format.h>

#include <algorithm>
#include <thread>

#include "harness/measure/building.h"
#include "harness/measure/counting.h"
#include "harness/measure/end_point_overlap.h"
#include "harness/measure/predicting.h"
#include "harness/measure/published.h"
#include "harness/measure/record.h"
#include "harness/measure/tested_kinds.h"
#include "harness/measure/timing.h"
#include "harness/measure/work_map.h"
#include "harness/verify/oracle.h"

namespace rayshoot {

namespace {

/// Passes are repeated within a repetition up to this length.
constexpr double kShortSeconds = 0.01;
/// Passes longer than this are not warmed up again: checking their answers has done that.
constexpr double kLongSeconds = 0.25;
/// Points of the surfaces by which end-point overlap is estimated.
constexpr std::size_t kEndPoints = 32'768;

std::string query_of(const RaySet& set) {
  if (set.closest_rays == set.rays.size()) return "closest";
  return set.closest_rays == 0 ? "any" : "closest+any";
}

/// A cell on its way through the steps of a measurement.
template <class Real>
struct Cell {
  const Built<Real>* built;
  report::Measurement measurement;
  std::unique_ptr<ThreadScratch<Real>> scratch;
  std::optional<Answers<Real>> answers;
  double pass_seconds = 0;

  const Engine<Real>& engine() const { return *built->engine; }
  bool timeable() const {
    return measurement.verdict.status == report::Status::ok ||
           measurement.verdict.status == report::Status::graded;
  }
};

template <class Real>
class GroupRun {
 public:
  GroupRun(const GroupInput& input, report::Report& report, RunObserver& observer,
           const std::function<bool()>& stopped)
      : input_(input),
        suite_(input.plan.suite),
        report_(report),
        observer_(observer),
        stopped_(stopped),
        all_threads_(static_cast<int>(std::max(1u, std::thread::hardware_concurrency()))),
        geometry_(compiled(input)) {
    geometry_.require_objects(input.scene.id);
    record_set_aside(report.scenes.back());
    take_sample();
  }

  /// Build what all rays share, then measure rays after rays.
  void run() {
    const auto searching = build(
        [&](const TechniqueChoice& technique) {
          const auto serves = [&](const PreparedRays* rays) { return wanted(technique, *rays); };
          return !technique.entry->info.needs_recorded_hits &&
                 std::any_of(input_.rays.begin(), input_.rays.end(), serves);
        },
        nullptr);
    references_.emplace(geometry_, reference_among(searching));
    for (const PreparedRays* rays : input_.rays)
      if (!stopped_()) measure(*rays, searching);
  }

 private:
  static Geometry<Real> compiled(const GroupInput& input) {
    const auto compiling = input.phases.scope(Phase::generate);
    return Geometry<Real>(input.scene, input.cone_sides, intersector_named(input.intersector),
                          input.plan.suite.bounds);
  }

  /// Structures are built once for all ray sets, so the sample is of them all.
  void take_sample() {
    std::vector<const RaySet*> sets;
    double rays = 0;
    for (const PreparedRays* prepared : input_.rays) {
      sets.push_back(&prepared->set);
      rays += static_cast<double>(prepared->set.rays.size());
    }
    sample_rays_ = sampled<Real>(sets);
    sample_ = {sample_rays_, rays / std::max(1.0, static_cast<double>(sample_rays_.size()))};
  }

  /// Objects by the reason for which they are not traced: the most that any precision has.
  void record_set_aside(report::Scene& scene) const {
    std::map<std::string, std::uint64_t> counts;
    for (const SetAside& object : geometry_.set_aside()) ++counts[object.reason];
    for (const auto& [reason, count] : counts)
      scene.set_aside[reason] = std::max(scene.set_aside[reason], count);
  }

  void announce(const std::string& step) const {
    observer_.doing(fmt::format("{} {} {}: {}", input_.scene.id, input_.scalar, input_.intersector, step));
  }

  bool wanted(const TechniqueChoice& technique, const PreparedRays& rays) const {
    return is_planned(technique, input_.scene.id) &&
           why_left_out(suite_, {input_.scene, *rays.spec, rays.set.rays.size(), technique, input_.scalar,
                                 input_.intersector})
               .empty();
  }

  template <class Choose>
  std::vector<Built<Real>> build(const Choose& choose, const RecordedHits<Real>* recorded) {
    const auto building = input_.phases.scope(Phase::build);
    std::vector<Built<Real>> built;
    for (const TechniqueChoice& technique : input_.plan.techniques) {
      if (stopped_() || !choose(technique)) continue;
      announce("building " + technique.spec);
      built.push_back(build_once(technique, geometry_, recorded, sample_));
    }
    if (!suite_.counts_only)
      repeat_builds(built, geometry_, recorded, sample_, suite_.repetitions, suite_.build_seconds, stopped_);
    return built;
  }

  /// Verify, then count, then time.
  void measure(const PreparedRays& rays, const std::vector<Built<Real>>& searching) {
    const Batch<Real> batch(rays.set);
    announce(fmt::format("searching {} exhaustively", rays.set.id));
    Oracle<Real> oracle = oracle_of(batch);
    const RecordedHits<Real> recorded = oracle.recorded();
    const auto replaying = build(
        [&](const TechniqueChoice& technique) {
          return technique.entry->info.needs_recorded_hits && wanted(technique, rays);
        },
        &recorded);

    std::vector<Cell<Real>> cells;
    for (const auto* built : {&searching, &replaying})
      for (const Built<Real>& one : *built)
        if (wanted(*one.choice, rays)) cells.push_back(new_cell(one, rays.set));
    verify(cells, batch, oracle);
    known_rays_.reset();
    for (Cell<Real>& cell : cells) count_cell(cell, batch, rays);
    if (suite_.graded_rays > 0) grade(cells, batch);
    if (!suite_.counts_only) time(cells, batch);
    compare_with_published(cells, rays.set);
    keep_complete(cells);
  }

  /// What is built already and may serve as the oracle's reference; null where there is nothing.
  static const Engine<Real>* reference_among(const std::vector<Built<Real>>& built) {
    const TechniqueEntry& entry = technique_entry(kReferenceTechnique);
    const Arguments defaults(entry.info.parameters, {}, entry.info.id);
    for (const Built<Real>& one : built)
      if (one.engine && one.choice->entry == &entry && one.choice->arguments.values() == defaults.values())
        return one.engine.get();
    return nullptr;
  }

  Oracle<Real> oracle_of(const Batch<Real>& batch) {
    const auto verifying = input_.phases.scope(Phase::verify);
    return Oracle<Real>(*references_, batch, suite_.check_tests, suite_.seed, all_threads_);
  }

  Cell<Real> new_cell(const Built<Real>& built, const RaySet& set) const {
    Cell<Real> cell{.built = &built};
    cell.measurement = {.scene = input_.scene.id,
                        .rays = fmt::format("{}/{}", input_.scene.id, set.id),
                        .technique = built.choice->entry->info.id,
                        .config = config_of(built.choice->arguments),
                        .scalar = input_.scalar,
                        .intersector = input_.intersector,
                        .query = query_of(set),
                        .build_ns = built.build_ns};
    if (!built.engine) fail(cell, built.failure);
    return cell;
  }

  /// Hold the nearest hits of rays spread over the batch against exact arithmetic.
  void grade(std::vector<Cell<Real>>& cells, const Batch<Real>& batch) {
    const std::size_t rays = batch.closest().size(), graded = std::min<std::size_t>(suite_.graded_rays, rays);
    if (graded == 0 || geometry_.has_placed()) return;
    const auto grading = input_.phases.scope(Phase::grade);
    announce(fmt::format("grading {} answers exactly", graded));
    if (!exact_) exact_.emplace(geometry_);
    for (Cell<Real>& cell : cells) {
      if (stopped_() || !cell.answers || cell.built->choice->entry->info.needs_recorded_hits) continue;
      Grades grades;
      for (std::size_t i = 0; i < graded; ++i) {
        const std::size_t ray = i * rays / graded;
        const Hit<Real>& hit = cell.answers->hits[ray];
        grades.add(exact_->grade(batch.closest()[ray], hit), hit.object != kNoObject);
      }
      cell.measurement.errors = record(grades);
    }
  }

  static void fail(Cell<Real>& cell, const std::string& why) {
    cell.measurement.verdict = {.status = report::Status::failed, .reference = "", .message = why};
  }

  void verify(std::vector<Cell<Real>>& cells, const Batch<Real>& batch, Oracle<Real>& oracle) {
    const auto verifying = input_.phases.scope(Phase::verify);
    std::vector<Statement<Real>> statements;
    std::vector<Cell<Real>*> judged;
    for (Cell<Real>& cell : cells) {
      if (stopped_() || !cell.built->engine) continue;
      announce("checking " + cell.built->choice->spec);
      const std::string failure = failure_of([&] {
        cell.scratch = std::make_unique<ThreadScratch<Real>>(cell.engine());
        cell.answers.emplace(batch);
        cell.pass_seconds =
            seconds_of([&] { trace(cell.engine(), batch, *cell.answers, *cell.scratch, all_threads_); });
      });
      if (!failure.empty()) {
        fail(cell, failure);
        continue;
      }
      statements.push_back({&cell.built->choice->entry->info, &*cell.answers});
      judged.push_back(&cell);
    }
    const auto verdicts = oracle.judge(statements);
    for (std::size_t i = 0; i < judged.size(); ++i) judged[i]->measurement.verdict = verdicts[i];
  }

  void count_cell(Cell<Real>& cell, const Batch<Real>& batch, const PreparedRays& rays) {
    if (stopped_() || !cell.timeable()) return;
    const auto counting = input_.phases.scope(Phase::count);
    announce("counting " + cell.built->choice->spec);
    report::Measurement& measurement = cell.measurement;
    measurement.structure = record(cell.engine().structure());
    measurement.predicted = predict(cell.engine(), batch);
    if (!cell.engine().countable()) return;
    const Counts counts =
        count(cell.engine(), batch, geometry_.numbers(), suite_.strict_tests, suite_.seed, all_threads_);
    const std::vector<std::string>& events = cell.built->choice->entry->info.events;
    measurement.work = record(counts.work, events);
    measurement.strict_work = record(counts.strict_work, events);
    measurement.efficiency = counts.efficiency;
    measurement.cells_deviation = counts.cells_deviation;
    measurement.tested_kinds = record(
        tested_kinds(cell.engine(), geometry_, batch, counts.work.object_tests, cell.scratch->local()));
    count_hierarchy(cell, batch);
    if (is_mapped(suite_, *cell.built->choice, *rays.spec))
      measurement.work_map = work_map(cell.engine(), batch, rows_of(rays.set), cell.scratch->local());
  }

  /// Eye rays are as many rows of as many.
  static std::uint64_t rows_of(const RaySet& set) {
    return static_cast<std::uint64_t>(std::lround(std::sqrt(set.counts.primary_rays)));
  }

  /// What is expected of a hierarchy of volumes, beyond equation (3).
  void count_hierarchy(Cell<Real>& cell, const Batch<Real>& batch) {
    if (cell.engine().path_tests().empty() || geometry_.has_placed()) return;
    if (!known_rays_) known_rays_.emplace(geometry_, batch, suite_.seed, all_threads_);
    if (!end_points_) end_points_ = surface_points(geometry_, kEndPoints, suite_.seed);
    cell.measurement.sampled_prediction = known_rays_->predict(cell.engine(), all_threads_);
    cell.measurement.end_point_overlap =
        end_point_overlap(cell.engine(), geometry_, *end_points_, all_threads_);
  }

  TimedPass timed_pass(Cell<Real>& cell, const Batch<Real>& batch, int threads) const {
    // The pass that was checked ran on all threads: their time together bounds that of one.
    const double estimate = cell.pass_seconds * all_threads_ / threads;
    return {.pass = [&cell, &batch,
                     threads] { trace(cell.engine(), batch, *cell.answers, *cell.scratch, threads); },
            .repetitions = affordable_repetitions(suite_.trace_seconds, estimate, suite_.repetitions),
            .min_seconds = estimate > kLongSeconds ? 0 : kShortSeconds};
  }

  void time(std::vector<Cell<Real>>& cells, const Batch<Real>& batch) {
    std::vector<TimedPass> passes;
    std::vector<Cell<Real>*> timed;
    std::vector<int> thread_counts{suite_.threads};
    thread_counts.insert(thread_counts.end(), suite_.thread_scaling.begin(), suite_.thread_scaling.end());
    for (Cell<Real>& cell : cells) {
      if (!cell.timeable()) continue;
      timed.push_back(&cell);
      for (const int threads : thread_counts) passes.push_back(timed_pass(cell, batch, threads));
    }
    announce(fmt::format("timing {} techniques in turns", timed.size()));
    const auto tracing = input_.phases.scope(Phase::trace);
    const auto times = time_interleaved(passes, stopped_);
    for (std::size_t i = 0; i < passes.size(); ++i) {
      report::Measurement& measurement = timed[i / thread_counts.size()]->measurement;
      const std::size_t which = i % thread_counts.size();
      if (which == 0)
        measurement.trace_ns = times[i];
      else
        measurement.threads.push_back({thread_counts[which], times[i]});
    }
  }

  /// Put our figures beside the published ones.
  void compare_with_published(std::vector<Cell<Real>>& cells, const RaySet& set) {
    const Published& published = input_.plan.published;
    const auto measured = [&](const std::string& spec) -> const report::Measurement* {
      for (const Cell<Real>& cell : cells)
        if (cell.built->choice->spec == spec) return &cell.measurement;
      return nullptr;
    };
    for (Cell<Real>& cell : cells)
      for (const PublishedRow& row : published.rows)
        if (row.scene == input_.scene.id && row.technique == cell.built->choice->spec)
          cell.measurement.published = compared(row, cell.measurement, set);
    for (const PublishedClaim& claim : published.claims)
      if (claim.scene == input_.scene.id)
        report_.claims.push_back(judged(claim, measured(claim.first), measured(claim.second), input_.scalar));
  }

  /// Whether all steps of a cell were done: a run may have been stopped before.
  bool complete(const Cell<Real>& cell) const {
    if (!cell.timeable()) return true;
    return suite_.counts_only ? !stopped_() : !cell.measurement.trace_ns.empty();
  }

  void keep_complete(std::vector<Cell<Real>>& cells) {
    for (Cell<Real>& cell : cells)
      if (complete(cell)) report_.measurements.push_back(std::move(cell.measurement));
    observer_.finished(cells.size());
  }

  const GroupInput& input_;
  const Suite& suite_;
  report::Report& report_;
  RunObserver& observer_;
  const std::function<bool()>& stopped_;
  int all_threads_;
  Geometry<Real> geometry_;
  std::vector<Ray<Real>> sample_rays_;
  RaySample<Real> sample_;
  std::optional<References<Real>> references_;
  std::optional<ExactOracle<Real>> exact_;
  /// Made when the first hierarchy needs them: for the rays at hand, and for all.
  std::optional<KnownRays<Real>> known_rays_;
  std::optional<std::vector<SurfacePoint>> end_points_;
};

}  // namespace

template <class Real>
void run_group(const GroupInput& input, report::Report& report, RunObserver& observer,
               const std::function<bool()>& stopped) {
  GroupRun<Real>(input, report, observer, stopped).run();
}

template void run_group<float>(const GroupInput&, report::Report&, RunObserver&,
                               const std::function<bool()>&);
template void run_group<double>(const GroupInput&, report::Report&, RunObserver&,
                                const std::function<bool()>&);

}  // namespace rayshoot
