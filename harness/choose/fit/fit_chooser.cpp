// Fits the constants of the chooser to reports and prints them as harness/choose/constants.json.
#include <fmt/format.h>

#include <cstdio>
#include <exception>

#include "harness/choose/fit.h"

int main(int count, char** arguments) try {
  if (count < 2) {
    fmt::print(stderr, "usage: fit_chooser REPORT...\n");
    return 2;
  }
  std::vector<rayshoot::report::Report> reports;
  for (int i = 1; i < count; ++i) reports.push_back(rayshoot::report::read_report(arguments[i]));
  fmt::print("{}", rayshoot::to_json(rayshoot::fit_constants(reports)));
  return 0;
} catch (const std::exception& error) {
  fmt::print(stderr, "fit_chooser: {}\n", error.what());
  return 2;
}
