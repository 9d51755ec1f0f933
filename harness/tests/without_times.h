#pragma once

#include <string>
#include <vector>

#include "harness/report/report.h"

namespace rayshoot::test {

/// What two runs of one plan have in common: all but when and how long, and the memory of Embree, which depends on what its
/// threads did.
inline std::string without_times(report::Report report) {
  report.run = {};
  report.environment.load.reset();
  for (report::Measurement& cell : report.measurements) {
    // That there were times is in common; how many depends on how long they are.
    for (std::vector<double>* times : {&cell.build_ns, &cell.trace_ns})
      if (!times->empty()) times->assign(1, 1);
    if (cell.technique.starts_with("embree") && cell.structure) cell.structure->bytes = 0;
  }
  return report::to_json(report);
}

}  // namespace rayshoot::test
