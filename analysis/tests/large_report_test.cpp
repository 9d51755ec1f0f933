// Thousands of cells: how long they take is told, not asserted.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <chrono>
#include <filesystem>
#include <sstream>

#include "analysis/compare/compare_tables.h"
#include "analysis/html/report_page.h"
#include "analysis/tables/comparison.h"
#include "analysis/tests/small_report.h"

namespace rayshoot::analysis {
namespace {

/// The small report so many times, each on a scene of its own, with nine repetitions.
report::Report repeated(int times) {
  const report::Report small = small_report();
  report::Report large;
  large.run.id = "large";
  for (int i = 0; i < times; ++i) {
    const auto renamed = [&](std::string id) { return id.replace(id.find(':'), 1, fmt::format("{}:", i)); };
    for (report::Scene scene : small.scenes) scene.id = renamed(scene.id), large.scenes.push_back(scene);
    for (report::RaySet rays : small.ray_sets) {
      rays.id = renamed(rays.id), rays.scene = renamed(rays.scene);
      large.ray_sets.push_back(rays);
    }
    for (report::Measurement cell : small.measurements) {
      cell.scene = renamed(cell.scene), cell.rays = renamed(cell.rays);
      if (!cell.trace_ns.empty()) cell.trace_ns.resize(9, cell.trace_ns.front());
      large.measurements.push_back(cell);
    }
  }
  return large;
}

/// Does something, and tells how long it took.
template <class Do>
auto told(const std::string& what, const Do& work) {
  const auto begin = std::chrono::steady_clock::now();
  auto result = work();
  const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - begin;
  fmt::print("{}: {:.3f} s\n", what, seconds.count());
  return result;
}

TEST(LargeReport, OfThousandsOfCellsIsReadAndShown) {
  const report::Report large = repeated(720);
  const std::string text = told("write 5040 cells", [&] { return report::to_json(large); });
  const report::Report read = told("read them", [&] { return report::from_json(text); });
  EXPECT_EQ(read.measurements.size(), 5040u);
  const std::string csv = told("their table as CSV", [&] { return render_comparison({read}, Format::csv); });
  EXPECT_EQ(std::count(csv.begin(), csv.end(), '\n'), 5041);
  told("their tables as text", [&] { return render_comparison({read}, Format::text); });
  const Comparison comparison =
      told("compare them with themselves", [&] { return compare(read, large, {}); });
  EXPECT_EQ(comparison.cells.size(), 5040u);
  EXPECT_FALSE(comparison.failed());
}

}  // namespace
}  // namespace rayshoot::analysis
