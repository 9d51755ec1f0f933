// Commands that read reports and nothing else, from end to end.
#include <fmt/format.h>
#include <gmock/gmock.h>

#include <filesystem>
#include <fstream>
#include <functional>

#include "harness/report/report.h"
#include "program.h"

namespace rayshoot::test {
namespace {

using ::testing::AllOf;
using ::testing::Contains;
using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::UnorderedElementsAre;

std::vector<std::string> files_in(const std::filesystem::path& folder) {
  std::vector<std::string> names;
  for (const auto& entry : std::filesystem::directory_iterator(folder))
    names.push_back(entry.path().filename());
  return names;
}

/// A folder with a report of four techniques on three scenes, timed for a moment.
class ReportCommands : public ::testing::Test {
 protected:
  static void SetUpTestSuite() {
    const TemporaryFolder folder;
    std::ofstream(folder.path() / "suite.json") << R"({
      "scenes": ["tetra:1", "tetra:2", "tetra:3"], "rays": ["whitted@17"], "repetitions": 6, "trace_seconds": 0.3,
      "techniques": ["bvh_sah", "uniform_grid", "kd_tree", "octree_glassner", "embree", "zero_overhead"]})";
    const Outcome run = run_program({"run", "suite.json", "-o", "r.json"}, folder.path());
    ASSERT_EQ(run.status, 0) << run.errors;
    measured_ = report::read_report((folder.path() / "r.json").string());
  }

  /// The report, changed, as a file in the folder.
  void write(
      const std::string& name, const std::function<void(report::Report&)>& change = [](report::Report&) {}) {
    report::Report report = measured_;
    change(report);
    report::write_report(report, (folder_.path() / name).string());
  }
  Outcome program(const std::vector<std::string>& arguments) {
    return run_program(arguments, folder_.path());
  }

  TemporaryFolder folder_;
  static report::Report measured_;
};

report::Report ReportCommands::measured_;

TEST_F(ReportCommands, CompareOfAReportWithItselfFindsNothing) {
  write("old.json");
  const Outcome same = program({"compare", "old.json", "old.json"});
  EXPECT_EQ(same.status, 0) << same.errors;
  EXPECT_THAT(same.output, HasSubstr("Of 18 cells: 0 slower, 0 faster, 0 with another count"));
}

TEST_F(ReportCommands, CompareFailsWhenACountChangesOrATimeGrows) {
  write("old.json");
  write("count.json", [](report::Report& report) { ++report.measurements[0].work->object_tests; });
  const Outcome count = program({"compare", "old.json", "count.json", "--format", "markdown"});
  EXPECT_EQ(count.status, 1);
  EXPECT_THAT(count.output, HasSubstr("| work.object\\_tests |"));
  write("slow.json", [](report::Report& report) {
    for (double& time : report.measurements[0].trace_ns) time *= 10;
  });
  EXPECT_EQ(program({"compare", "old.json", "slow.json"}).status, 1);
  EXPECT_EQ(program({"compare", "slow.json", "old.json"}).status, 0) << "faster is no failure";
  EXPECT_EQ(program({"compare", "old.json", "slow.json", "--tolerance", "10"}).status, 0);
}

TEST_F(ReportCommands, ReportWritesAPageAndItsPlots) {
  write("r.json");
  const Outcome page = program({"report", "r.json"});
  EXPECT_EQ(page.status, 0) << page.errors;
  EXPECT_THAT(page.output, HasSubstr("Page: r.html, and "));
  EXPECT_THAT(files_in(folder_.path()),
              AllOf(Contains("r.html"), Contains("r-predicted-measured-objects.svg"),
                    Contains("r-scaling-time-tetra-as-curves-whitted-17-float.svg")));
}

TEST_F(ReportCommands, WorkMapsAreTakenWhereAskedForAndDrawn) {
  const std::vector<std::string> run{"run",         "--scene", "tetra:1",     "--rays",       "primary@9",
                                     "--technique", "bvh_sah", "--technique", "octree_samet", "--counts-only",
                                     "-o",          "r.json",  "--work-map"};
  const auto with = [&](const std::string& technique) {
    std::vector<std::string> arguments = run;
    arguments.push_back(technique);
    return program(arguments);
  };
  const Outcome unknown = with("bvh_sa");
  EXPECT_EQ(unknown.status, 2);
  EXPECT_THAT(unknown.errors, HasSubstr("did you mean 'bvh_sah'?"));
  ASSERT_EQ(with("bvh_sah").status, 0);
  ASSERT_EQ(program({"report", "r.json"}).status, 0);
  EXPECT_THAT(files_in(folder_.path()),
              AllOf(Contains("r-work-map-objects-bvh_sah-tetra-1-curves-primary-9-float.svg"),
                    Contains("r-work-map-volumes-bvh_sah-tetra-1-curves-primary-9-float.svg"),
                    Not(Contains(HasSubstr("octree_samet")))));
}

TEST_F(ReportCommands, ReportLeavesNothingHalfWritten) {
  write("r.json");
  std::filesystem::create_directory(folder_.path() / "page-predicted-measured-objects.svg");
  const Outcome blocked = program({"report", "r.json", "-o", "page.html"});
  EXPECT_EQ(blocked.status, 2);
  EXPECT_THAT(blocked.errors, HasSubstr("cannot write page-predicted-measured-objects.svg"));
  EXPECT_THAT(files_in(folder_.path()),
              UnorderedElementsAre("r.json", "page-predicted-measured-objects.svg"));
}

TEST_F(ReportCommands, ValidateFailsWhenABoundDoes) {
  write("r.json");
  const Outcome verdicts = program({"validate", "r.json"});
  EXPECT_EQ(verdicts.status, 0) << verdicts.errors;
  EXPECT_THAT(verdicts.output, HasSubstr("havran_by_technique, float"));
  const Outcome bound = program({"validate", "r.json", "--max-median-error", "1e-9", "--model", "havran"});
  EXPECT_EQ(bound.status, 1);
  EXPECT_THAT(bound.output, AllOf(HasSubstr("FAILS"), Not(HasSubstr("candidates"))));
  EXPECT_EQ(program({"validate", "r.json", "--max-median-error", "1000", "--min-spearman", "-1", "--model",
                     "havran"})
                .status,
            0);
  const Outcome cells = program({"validate", "r.json", "--format", "csv"});
  EXPECT_THAT(cells.output,
              HasSubstr("technique,cell,model,measured_ns_per_ray,predicted_ns_per_ray,error\n"));
}

TEST_F(ReportCommands, ValidateHoldsExpectedTestsAgainstCountedOnes) {
  write("r.json");
  const Outcome tests = program({"validate", "r.json", "--tests"});
  EXPECT_EQ(tests.status, 0) << tests.errors;
  EXPECT_THAT(tests.output, AllOf(HasSubstr("equation_3_occluded"), HasSubstr("Tests of a ray, whitted"),
                                  Not(HasSubstr("havran"))));
  const Outcome bound =
      program({"validate", "r.json", "--tests", "--max-test-error", "0.05", "--model", "equation_3"});
  EXPECT_EQ(bound.status, 1) << "surface areas know nothing of these rays";
  EXPECT_EQ(program({"validate", "r.json", "--tests", "--max-test-error", "1000"}).status, 0);
  EXPECT_EQ(program({"validate", "r.json", "--max-test-error", "1"}).status, 2);
  const Outcome nothing = program({"validate", "r.json", "--tests", "--model", "havran"});
  EXPECT_EQ(nothing.status, 2);
  EXPECT_THAT(nothing.errors, HasSubstr("no cell has expected tests"));
}

TEST_F(ReportCommands, TablesOfOnesOwn) {
  write("r.json");
  const Outcome table = program({"table", "--rows", "technique", "--columns", "scene", "--metric", "nodes",
                                 "r.json", "--technique", "bvh_*", "--format", "csv"});
  EXPECT_EQ(table.status, 0) << table.errors;
  EXPECT_THAT(table.output,
              HasSubstr("technique,rays,precision,metric,tetra:1/curves,tetra:2/curves,tetra:3/curves\n"
                        "bvh_sah,whitted@17,float,nodes,"));
}

}  // namespace
}  // namespace rayshoot::test
