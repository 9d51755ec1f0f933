#pragma once

#include <vector>

#include "analysis/tables/groups.h"
#include "analysis/tables/table.h"

/// The tables of `rayshoot run` and `rayshoot table`.
namespace rayshoot::analysis {

/// One table for each scene, ray set and precision of each report: technique by technique, what it did, what
/// equation (3) predicts, what it costs, and how that compares with zero_overhead and Embree.
std::vector<Table> comparison_tables(const std::vector<report::Report>& reports);

/// One table for each precision of each report with several groups: geometric means over them.
std::vector<Table> overview_tables(const std::vector<report::Report>& reports);

/// One table for each group in which thread scaling was measured.
std::vector<Table> scaling_tables(const std::vector<report::Report>& reports);

/// One table for each scene that was measured in several sizes, rays and precision: with what power of the number of objects
/// time, tests, build and memory of each technique grow.
std::vector<Table> growth_tables(const std::vector<report::Report>& reports);

/// Of these all; empty where no scene was measured in enough sizes.
std::string render_growth(const std::vector<report::Report>& reports, Format format);

/// For each group with published figures, these beside ours; what was published of times, and whether ours agree.
std::vector<Table> published_tables(const std::vector<report::Report>& reports);

/// For each technique that the program chose, what it weighed and why it chose so; then what all choices cost beside what
/// could have been chosen, where that was measured.
std::vector<Table> choice_tables(const std::vector<report::Report>& reports);

/// Of these the last alone; empty where no choice was measured beside the other candidates.
std::string render_regret(const std::vector<report::Report>& reports, Format format);

/// All of these; in CSV the comparison alone, whose rows have everything.
std::string render_comparison(const std::vector<report::Report>& reports, Format format);

/// A column of the comparison and where its cells come from.
struct ComparisonColumn {
  Column column;
  Cell (*cell)(const Group& group, const Entry& entry);
};

const std::vector<ComparisonColumn>& comparison_columns();

/// Columns that several tables share.
Column technique_column();
Column time_column();
Column zero_overhead_column();
Column embree_column();

/// The scalar of a group, and its intersector where that is not the default: "float, watertight".
std::string precision_of(const Group& group);
/// "[run] scene, rays, precision", the run where there are several reports.
std::string title_of(const Group& group, bool several_reports);

}  // namespace rayshoot::analysis
