#pragma once

#include <optional>
#include <string>
#include <vector>

#include "analysis/statistics/sample.h"
#include "harness/report/report.h"

/// Measurements that may be compared with each other, and the numbers that follow from them. All pointers lead into
/// the report, which must outlive them.
namespace rayshoot::analysis {

inline constexpr const char* kZeroOverhead = "zero_overhead";
inline constexpr const char* kEmbree = "embree";

/// A measurement with what it is compared with.
struct Entry {
  const report::Measurement* measurement = nullptr;
  /// The technique, with those keys of its configuration that differ within the report.
  std::string label;
  /// Number of rays; 0 when the report does not list them.
  std::uint64_t rays = 0;
  /// The fastest zero_overhead and the fastest embree of the group, of those that trace ray by ray where there are some; null
  /// where none was timed.
  const report::Measurement *zero_overhead = nullptr, *embree = nullptr;
};

/// All measurements of a scene, its rays, a precision and an intersector, sorted: by time, or by tests per ray where
/// there is no time; then those that are wrong, and those that failed.
struct Group {
  const report::Report* report = nullptr;
  std::string scene_id, rays_id, scalar, intersector;
  /// Null when the report does not list them.
  const report::Scene* scene = nullptr;
  const report::RaySet* rays = nullptr;
  std::vector<Entry> entries;
  std::vector<const report::LeftOutCell*> left_out;
};

/// In the order of the report's scenes.
std::vector<Group> groups(const report::Report& report);

/// Whether rays are traced one by one, as by every technique but Embree in its modes stream and packet, and bvh_wide in batches.
bool traces_ray_by_ray(const report::Measurement& measurement);

/// Nanoseconds a ray: the median of the repetitions.
std::optional<Estimate> time_per_ray(const Entry& entry);

/// Time over that of zero_overhead, and Embree's time over it.
std::optional<Estimate> times_zero_overhead(const Entry& entry);
std::optional<Estimate> times_embree(const Entry& entry);

/// A count over the rays it was taken of; nothing where it was not taken.
std::optional<double> per_ray(const std::optional<report::Work>& work, std::uint64_t report::Work::*count);

/// The work that equation (3) is held against: that of the strict optimizer where it is known.
const std::optional<report::Work>& equation_3_basis(const report::Measurement& measurement);

}  // namespace rayshoot::analysis
