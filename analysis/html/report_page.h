#pragma once

#include <string>
#include <vector>

#include "analysis/plots/plots.h"
#include "harness/report/report.h"

namespace rayshoot::analysis {

/// A picture in the format PNG, such as `rayshoot render` draws, and what it is called.
struct Picture {
  std::string name, png;
};

/// All that reports say, on one page, and its plots as files of their own.
struct ReportPage {
  std::string html;
  /// Names of files and what is in them.
  std::vector<std::pair<std::string, std::string>> plots;
};

/// Summary in words, comparison, plots, tables, provenance, and what was left out; pictures where they are given.
ReportPage report_page(const std::vector<report::Report>& reports, const std::vector<Picture>& pictures = {});

}  // namespace rayshoot::analysis
