#pragma once

#include <string>
#include <vector>

#include "analysis/cost_models/verdicts.h"
#include "analysis/tables/groups.h"

/// Every figure of a report, one file each. Their numbers come from the report's groups.
namespace rayshoot::analysis {

struct Plot {
  /// Name of its file, without what ends it.
  std::string name;
  std::string title;
  /// What is to be seen, for a line below it.
  std::string caption;
  /// An element for a page (svg.h).
  std::string svg;
};

/// Plots of one kind, or why there are none.
struct PlotSet {
  std::string kind;
  std::vector<Plot> plots;
  std::string left_out;
};

/// Equation (3) against the tests that were counted, with the line of equality.
PlotSet predicted_measured_plots(const std::vector<Group>& groups);
/// Times that the best cost model predicts against those that were measured.
PlotSet model_time_plots(const std::vector<Group>& groups, const Validation& models);
/// Wrong answers and errors in distance against run time, with the frontier.
PlotSet error_time_plots(const std::vector<Group>& groups);
/// Object tests, volume tests and steps per ray, technique by technique.
PlotSet work_bars_plots(const std::vector<Group>& groups);
/// Time to build against time to trace, with the frontier.
PlotSet build_trace_plots(const std::vector<Group>& groups);
/// Time and memory over the number of objects, with exponents.
PlotSet object_scaling_plots(const std::vector<Group>& groups);

/// How many times faster more threads are; cells of several reports that differ in their threads alone are one.
PlotSet thread_scaling_plots(const std::vector<Group>& groups);
/// Tests and steps over the stiffness of scenes, and of the settings of the numerical suite, with exponents.
PlotSet stiffness_work_plots(const std::vector<Group>& groups, const std::vector<report::Report>& reports);
/// The work of eye rays, pixel by pixel, of the cells that hold a map of it.
PlotSet work_map_plots(const std::vector<Group>& groups);

/// All of these, in this order.
std::vector<PlotSet> all_plots(const std::vector<Group>& groups, const std::vector<report::Report>& reports,
                               const Validation& models);

/// "balls:3/curves, whitted@65, float" as part of a file's name: letters, digits, hyphens and points.
std::string file_name_of(const std::string& text);

}  // namespace rayshoot::analysis
