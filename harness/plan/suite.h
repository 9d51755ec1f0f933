#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "scenes/core/geometry.h"
#include "scenes/core/spec.h"

namespace rayshoot {

/// Cells that a suite leaves out: those that match all that is given here. Patterns may hold `*` and `?`.
struct Exclusion {
  std::string scene = "*", rays = "*", technique = "*", scalar = "*", intersector = "*";
  /// Matches only scenes with more objects, ray sets with more rays.
  std::uint64_t objects_over = 0, rays_over = 0;
  std::string why = "the suite leaves it out";
};

/// What a run is asked to do: every combination of scene, rays, technique, scalar and intersector, and how to measure it.
struct Suite {
  std::string name;
  /// Specifications. Lists of parameter values in a suite file have become one specification each.
  std::vector<std::string> scenes, rays{"whitted"}, techniques{"all"}, scalars{"float"}, intersectors{"fast"};
  std::vector<Exclusion> exclude;
  /// How bounds are drawn around objects.
  BoundsRule bounds = BoundsRule::tight;
  /// Published figures to hold the run against, by name; empty for none. Their scenes stand in for `scenes` where it is
  /// empty, and "published" among `techniques` for what they are about, each on its scenes alone.
  std::string published;

  std::uint64_t seed = 1;
  /// Given to every ray distribution that has a parameter of that name, unless its specification gives
  /// another.
  std::optional<int> resolution;
  std::optional<std::string> rules;
  /// Resolution of the patches of scenes in that form.
  std::optional<int> tessellation;

  /// Threads that trace the timed passes; further numbers of threads to time for a scaling curve.
  int threads = 1;
  std::vector<int> thread_scaling;
  /// Count and verify, but take no time.
  bool counts_only = false;
  /// Repetitions of every build and of every trace, fewer where the seconds below do not allow them.
  int repetitions = 9;
  double build_seconds = 1, trace_seconds = 2;
  /// Ray-object tests to spend on checking the rays of a scene by exhaustive search.
  double check_tests = 5e8;
  /// Nearest hits of every ray set that exact arithmetic grades, technique by technique.
  std::uint64_t graded_rays = 0;
  /// Take as many rays as it needs until half the 95 % interval of every technique's M is so small a part of M; 0 for the
  /// number of rays that was asked for.
  double target_m_error = 0;
  /// Techniques, as asked for or by id, whose work is mapped pixel by pixel on rays that begin with eye rays.
  std::vector<std::string> work_maps{};
  /// Ray-object tests to spend on counting the work of a strict optimizer.
  double strict_tests = 1e8;
};

/// Read a suite in JSON, comments allowed; `name` is named in messages. Throws InputError on anything that is
/// not accepted, naming what would have been.
Suite parse_suite(const std::string& text, const std::string& name);

/// Names of the suites that come with the program.
std::vector<std::string> builtin_suites();

/// A built-in suite, or the suite in a file. Throws InputError when there is no such thing.
Suite load_suite(const std::string& name_or_path);

}  // namespace rayshoot
