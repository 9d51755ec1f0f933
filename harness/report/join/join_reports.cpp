// Joins reports of scenes that were run one by one: join_reports REPORT... -o REPORT.
#include <fmt/format.h>

#include <cstdio>
#include <string_view>

#include "harness/report/join.h"

int main(int count, char** arguments) try {
  if (count < 4 || std::string_view(arguments[count - 2]) != "-o") {
    fmt::print(stderr, "usage: join_reports REPORT... -o REPORT\n");
    return 2;
  }
  std::vector<rayshoot::report::Report> reports;
  for (int i = 1; i < count - 2; ++i) reports.push_back(rayshoot::report::read_report(arguments[i]));
  rayshoot::report::write_report(rayshoot::report::joined(reports), arguments[count - 1]);
  return 0;
} catch (const std::exception& error) {
  fmt::print(stderr, "join_reports: {}\n", error.what());
  return 2;
}
