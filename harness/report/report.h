#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <stdexcept>
#include <string>
#include <variant>
#include <vector>

/// The report: everything a run found out, raw. Field names are the JSON members of
/// results/schema/report.schema.json, units are in the names, and what was not measured is absent.
namespace rayshoot::report {

inline constexpr int kSchemaVersion = 1;

struct Run {
  std::string id;
  std::string command;
  std::string started_utc;
  double seconds = 0;
  /// What these seconds went into: generate, hash, rays, build, verify, count, grade, trace, other. Builds and traces are the
  /// timed work.
  std::map<std::string, double> phase_seconds;
  std::string git_commit;
  bool git_dirty = false;
  std::uint64_t seed = 1;
  /// How bounds were drawn around objects: "tight" or "havran".
  std::string bounds = "tight";
  /// Source of the published figures that the run was held against.
  std::optional<std::string> published;
  /// False when the run was interrupted: the report then holds what had finished.
  bool complete = true;
};

struct Environment {
  std::string cpu;
  int cores = 0;
  /// Cache sizes by name: "l1d", "l2", "l3".
  std::map<std::string, std::uint64_t> caches_bytes;
  std::string governor;
  /// Load average of the last minute when the run started.
  std::optional<double> load;
  std::string os;
  std::string compiler;
  std::string flags;
  std::map<std::string, std::string> packages;
};

struct LeftOut {
  std::string what, why;
};

struct Bounds {
  std::array<double, 3> min{}, max{};
};

struct Scene {
  std::string id;
  std::string generator;
  std::optional<std::int64_t> size;
  std::string form;
  std::uint64_t objects = 0;
  /// Objects by kind: "triangle", "polygon", "sphere", "cone".
  std::map<std::string, std::uint64_t> counts;
  /// Absent for a scene without objects.
  std::optional<Bounds> bounds;
  std::string hash;
  /// Scene diagonal over smallest feature; absent where the scene has none.
  std::optional<double> stiffness;
  std::map<std::string, bool> needs;
  /// Objects that could not be traced, by reason.
  std::map<std::string, std::uint64_t> set_aside;
  std::vector<LeftOut> left_out;
};

struct RaySet {
  std::string id;
  std::string scene;
  std::string distribution;
  /// Absent where the distribution has no rule set.
  std::optional<std::string> rules;
  std::uint64_t rays = 0, closest_rays = 0, any_rays = 0;
  std::uint64_t primary_rays = 0, primary_hits = 0, shadow_rays = 0, shadow_hits = 0;
  std::uint64_t reflected_rays = 0, refracted_rays = 0, total_internal_reflections = 0, secondary_hits = 0;
  std::string hash;
};

/// ok: every checked ray agrees. wrong: some do not, so there is no time. failed: it could not be built or traced.
/// graded: an engine with an object test of its own, whose differing rays are counted but do not forbid a time.
enum class Status { ok, wrong, graded, failed };

struct Verdict {
  Status status = Status::ok;
  std::uint64_t checked_rays = 0;
  std::uint64_t wrong_rays = 0;
  /// What the answers were compared with: "exhaustive" or the id of a technique verified against it.
  std::string reference;
  /// For a failed cell, why.
  std::optional<std::string> message;
};

struct Work {
  std::uint64_t rays = 0, object_tests = 0, distinct_objects = 0, volume_tests = 0, steps = 0, cells = 0,
                empty_cells = 0, mailbox_hits = 0;
  /// What only this technique counts, by name.
  std::map<std::string, std::uint64_t> events{};
};

struct Structure {
  std::uint64_t nodes = 0, leaves = 0, empty_leaves = 0, references = 0, max_depth = 0, bytes = 0;
  /// What only this technique has, by name.
  std::map<std::string, double> figures{};
};

/// Shares of the ray-object tests by kind of object, of the distinct candidates of rays, and the vertices of polygons by test
/// of any kind.
struct TestedKinds {
  double triangles = 0, polygons = 0, spheres = 0, cones = 0, polygon_vertices = 0;
};

/// Equation (3), per ray of the set: the expected tests of a ray that hits the root volume times the fraction of
/// rays that do, and the root volume's own test.
struct Predicted {
  double object_tests_per_ray = 0, volume_tests_per_ray = 0;
};

/// Equation (3) per ray of the set with the chances of a sample of its rays in place of surface areas.
struct SampledPrediction {
  /// How many rays the chances are of.
  std::uint64_t sampled_rays = 0;
  /// A volume is entered by all rays that meet it; by those that meet it no farther than their nearest hit; and by those
  /// that still look for something when the search, in the order of the technique, comes to it.
  Predicted unoccluded, occluded, ordered;
};

/// End-point overlap (Aila, Karras & Laine 2013): the tests of a ray that would end at a random point of the surfaces, in
/// volumes in which the object of the point is not.
struct EndPointOverlap {
  /// How many points it was estimated from.
  std::uint64_t points = 0;
  double object_tests_per_point = 0, volume_tests_per_point = 0;
};

/// Work of the eye rays that a ray set begins with, summed over square tiles of their pixels, in rows from the upper left.
struct WorkMap {
  /// Rows and columns of eye rays, and of those of a tile; tiles at the right and lower edge may have fewer.
  std::uint64_t resolution = 1, tile = 1;
  std::vector<std::uint64_t> object_tests, volume_tests;

  /// Rows and columns of tiles.
  std::uint64_t columns() const { return (resolution + tile - 1) / tile; }
  /// Eye rays of a tile.
  std::uint64_t rays(std::uint64_t index) const {
    const auto side = [&](std::uint64_t place) { return std::min(tile, resolution - place * tile); };
    return side(index % columns()) * side(index / columns());
  }
};

/// Rows of eye rays that a map may have.
inline constexpr std::uint64_t kMostMapRows = 16384;

/// Revelles' M, equation (21), with 95 % confidence intervals.
struct Efficiency {
  double m = 0;
  std::array<double, 2> m_ci95{};
  double m_strict = 0;
  std::array<double, 2> m_strict_ci95{};
};

/// Errors in units in the last place. Quantiles are those of a histogram: at most 5 % too large.
struct Ulps {
  double median = 0, p99 = 0, p999 = 0, max = 0;
};

/// Nearest hits held against exact arithmetic. Answers by class: "exact", "ambiguous", "near", "wrong_object",
/// "false_miss", "false_hit", "not_a_number", "over_steps", "crash".
struct Errors {
  std::uint64_t graded_rays = 0;
  std::map<std::string, std::uint64_t> answers;
  std::optional<Ulps> ulps_of_t, ulps_of_point;
};

/// How many answers exact arithmetic refutes: of no class that a border or a few ulps excuse.
inline std::uint64_t wrong_answers(const Errors& errors) {
  std::uint64_t wrong = 0;
  for (const auto& [name, count] : errors.answers)
    if (name != "exact" && name != "ambiguous" && name != "near") wrong += count;
  return wrong;
}

/// Trace times with a number of threads, one entry a repetition.
struct ThreadTimes {
  int threads = 1;
  std::vector<double> trace_ns;
};

using ConfigValue = std::variant<bool, std::int64_t, double, std::string>;

/// A published figure of a technique on a scene and ours, which is absent where it was not measured.
struct PublishedFigure {
  std::string figure;
  /// What the source calls the technique.
  std::string label;
  double theirs = 0;
  std::optional<double> ours;
};

/// What was published about the times of two techniques on a scene, "faster" or "similar", and what ours are.
struct Claim {
  std::string scene;
  std::string scalar;
  std::string first, second;
  std::string relation;
  /// Absent where one of them was not timed.
  std::optional<double> first_over_second;
  std::optional<bool> holds;
};

struct Measurement {
  std::string scene;
  std::string rays;
  std::string technique;
  std::map<std::string, ConfigValue> config;
  std::string scalar;
  /// The ray-object test: "fast", "watertight" or "exact".
  std::string intersector = "fast";
  /// "closest", "any", or "closest+any" where the ray set asks both.
  std::string query;
  Verdict verdict;
  std::optional<Work> work;
  /// Work of the strict optimizer on the same rays, or on the random subset that `rays` of it counts.
  std::optional<Work> strict_work;
  std::optional<TestedKinds> tested_kinds;
  std::optional<Structure> structure;
  std::optional<Predicted> predicted;
  std::optional<SampledPrediction> sampled_prediction;
  std::optional<EndPointOverlap> end_point_overlap;
  /// Standard deviation, over the rays, of the leaf cells visited: leaf-count variability (Aila, Karras & Laine 2013).
  std::optional<double> cells_deviation;
  /// Where it was asked for.
  std::optional<WorkMap> work_map;
  std::optional<Efficiency> efficiency;
  std::optional<Errors> errors;
  /// Wall time of each build and of each pass over the whole batch, in nanoseconds.
  std::vector<double> build_ns, trace_ns;
  /// Threads that traced while `trace_ns` was taken.
  int trace_threads = 1;
  /// Thread scaling, where asked for.
  std::vector<ThreadTimes> threads;
  /// Where figures for this cell were published.
  std::vector<PublishedFigure> published;
};

/// Answers of a technique to the rays of one setting of a torture case, held against exact arithmetic and against what
/// the case promises.
struct Grading {
  std::string torture_case;
  std::string setting;
  /// What must hold: "as_oracle", "always_hit", "never_hit" or "same_as_base".
  std::string property;
  std::string technique;
  std::map<std::string, ConfigValue> config;
  std::string scalar;
  std::string intersector = "fast";
  /// Whether denormal numbers were taken as zero.
  bool flush_to_zero = false;
  std::uint64_t objects = 0, set_aside = 0;
  /// Scene diagonal over smallest feature; absent where the scene has none.
  std::optional<double> stiffness;
  /// The x of the case.
  double parameter = 0;
  /// The setting that this one is a stressed form of.
  std::optional<std::string> base;
  /// Rays answered.
  std::uint64_t rays = 0;
  /// Of those that were graded; "over_steps" and "crash" count among all.
  Errors errors;
  /// Misses where the property forbids them, and hits where it does; answers that differ from the base's.
  std::uint64_t leaks = 0, forbidden_hits = 0, changed = 0;
  /// Graded rays for which the any-hit query, or tracing with more threads, says something else.
  std::uint64_t any_differs = 0, threads_differ = 0;
  /// Crossings of graded rays with objects that were not among the strict optimizer's candidates; absent where they
  /// were not looked for.
  std::optional<std::uint64_t> crossings_lost;
  /// Work of the first rays, and the most steps that one of them took.
  std::optional<Work> work;
  std::uint64_t most_steps = 0;
  /// Why nothing was traced, or why it was given up.
  std::optional<std::string> message;
};

/// A technique that the chooser weighed: what it does for a ray of the sample, and what that is expected to cost.
struct Candidate {
  /// Specification that was asked for, and what measurements call it.
  std::string spec;
  std::string technique;
  std::map<std::string, ConfigValue> config;
  /// Per ray, by the names of the terms of the cost: "triangle_test", "step" and so on.
  std::map<std::string, double> counts;
  double build_ns = 0;
  /// Absent where no constants are known for the technique.
  std::optional<double> predicted_ns_per_ray;
  /// Nanoseconds a ray, one entry a round, where it was in the race between near ties.
  std::vector<double> race_ns_per_ray;
};

/// Which technique was chosen for rays in a scene, out of which, and why.
struct Choice {
  std::string scene, rays, scalar;
  std::string intersector = "fast";
  /// Cheap statistics of the scene, by name.
  std::map<std::string, double> statistics;
  /// Candidates that were left out before anything was built.
  std::vector<LeftOut> left_out;
  std::uint64_t sample_rays = 0;
  /// The cheapest by prediction first.
  std::vector<Candidate> candidates;
  /// Where and when the constants of the prediction were measured, and whether this scene was among those.
  std::string constants;
  bool fitted = false;
  /// Rays that the build is to serve, where its time counts.
  std::optional<double> expected_rays;
  /// Specifications of the cheapest by prediction and of what was chosen, and the reason in words.
  std::string predicted, pick, why;
  /// What choosing took.
  double seconds = 0;
};

/// A cell that was planned and not run; `technique` is the specification that was asked for.
struct LeftOutCell {
  std::string scene, rays, technique, scalar;
  std::string intersector = "fast";
  std::string why;
};

struct Report {
  Run run;
  Environment environment;
  std::vector<Scene> scenes;
  std::vector<RaySet> ray_sets;
  std::vector<Measurement> measurements;
  std::vector<LeftOutCell> left_out;
  /// What was published of times, where the run was held against it.
  std::vector<Claim> claims;
  /// What `rayshoot torture` found out.
  std::vector<Grading> gradings;
  /// Techniques that the program was left to choose.
  std::vector<Choice> choices;
};

/// Thrown when a file is not a report or cannot be read or written; `what()` is one line.
class ReportError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Read a report. Throws ReportError, with the file and the JSON path of the first fault, on what is not one.
Report read_report(const std::string& path);

/// Write to a temporary file beside `path`, then rename. Throws ReportError when that fails.
void write_report(const Report& report, const std::string& path);

/// The JSON text of a report. A number that is not finite is absent, and so is the optional member it belongs to;
/// throws ReportError where a required member is not finite.
std::string to_json(const Report& report);

/// The inverse of `to_json`. Members that are unknown, missing or of another type are errors, and so are another
/// schema version, a measurement of a scene or ray set that the report does not list, and a time of a wrong answer.
Report from_json(const std::string& text);

}  // namespace rayshoot::report
