#pragma once

#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "analysis/plots/svg.h"
#include "analysis/tables/groups.h"

namespace rayshoot::analysis {

/// Gives every technique of a report the same marker in all plots.
class SeriesStyles {
 public:
  explicit SeriesStyles(const std::vector<Group>& groups);
  explicit SeriesStyles(const std::set<std::string>& labels);
  MarkerStyle operator()(const std::string& label) const { return styles_.at(label); }
  /// A legend of those that are named, in the order of their names.
  std::vector<std::pair<std::string, MarkerStyle>> legend(const std::vector<std::string>& labels) const;

 private:
  std::map<std::string, MarkerStyle> styles_;
};

/// Whether a cell's answers are right, so that its work and time mean something.
bool is_right(const Entry& entry);

/// A quantity of a cell; nothing where it was not measured.
using Quantity = std::optional<double> (*)(const Entry&);

std::optional<double> trace_ns_per_ray(const Entry& entry);
/// Nothing for what builds nothing: exhaustive search and the replay of known hits.
std::optional<double> build_milliseconds(const Entry& entry);
std::optional<double> structure_bytes(const Entry& entry);

/// The groups of one precision.
struct Precision {
  std::string name;
  std::vector<const Group*> groups;
};
std::vector<Precision> precisions(const std::vector<Group>& groups);

/// A technique and the geometric means of some quantities over the groups in which it is right. Only those that are right
/// in all groups that a mean is taken of compare.
struct MeanRow {
  std::string label;
  std::size_t groups = 0;
  std::vector<std::optional<double>> means;
};

/// Techniques that are right in all the groups and have at least the first quantity in them, sorted by it; the others
/// are counted in `left_out`.
std::vector<MeanRow> mean_rows(const std::vector<const Group*>& groups,
                               const std::vector<Quantity>& quantities, std::vector<std::string>& left_out);

/// "balls:3/curves, whitted@65, float" for one group, "8 scenes and rays, float" for several.
std::string title_of_groups(const Precision& precision);

}  // namespace rayshoot::analysis
