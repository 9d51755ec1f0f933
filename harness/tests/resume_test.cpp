// Runs that are killed at any moment and gone on with, and runs in parts: what comes out is what one run makes.
#include <fmt/format.h>
#include <gmock/gmock.h>

#include <chrono>
#include <fstream>
#include <random>

#include "program.h"
#include "without_times.h"

namespace rayshoot::test {
namespace {

using Milliseconds = std::chrono::milliseconds;

report::Report read(const TemporaryFolder& folder, const std::string& name) {
  return report::read_report((folder.path() / name).string());
}

/// A timed run of six scenes.
class KilledRun : public ::testing::Test {
 protected:
  void SetUp() override {
    std::ofstream(folder_.path() / "suite.json") << R"suite({
      "scenes": ["tetra:1", "balls:1", "gears:1", "tetra:3", "lattice:1", "tree:6"], "rays": ["whitted@17"],
      "repetitions": 2, "trace_seconds": 0.005, "techniques": ["bvh_sah", "uniform_grid", "embree"]})suite";
    const auto begin = std::chrono::steady_clock::now();
    ASSERT_EQ(run("whole.json").status, 0);
    whole_takes_ = std::chrono::duration_cast<Milliseconds>(std::chrono::steady_clock::now() - begin);
    whole_ = without_times(read(folder_, "whole.json"));
  }

  static std::vector<std::string> arguments(const std::string& output,
                                            const std::vector<std::string>& more = {}) {
    std::vector<std::string> all{"run", "suite.json", "-o", output, "--resume"};
    all.insert(all.end(), more.begin(), more.end());
    return all;
  }
  Outcome run(const std::string& output, const std::vector<std::string>& more = {}) const {
    return run_program(arguments(output, more), folder_.path());
  }

  /// Kill a run at a moment between its beginning and its end, if it lasts that long.
  Outcome kill_at_random(const std::string& output, const std::vector<std::string>& more = {}) {
    const auto moment =
        std::uniform_int_distribution<int>(0, static_cast<int>(whole_takes_.count()))(moments_);
    return kill_program(arguments(output, more), Milliseconds(moment), folder_.path());
  }

  /// Every report that lies in the folder can be read: nothing half-written has its name.
  void expect_readable(const std::string& output) const {
    for (const std::string& name : {output, output + ".unfinished"})
      if (std::filesystem::exists(folder_.path() / name)) {
        EXPECT_NO_THROW(read(folder_, name)) << name;
      }
  }

  /// Kill a run and go on with it, each time from its beginning.
  void kill_and_resume(int times) {
    int killed = 0;
    for (int i = 0; i < times; ++i) {
      const std::string output = fmt::format("killed-{}.json", i);
      killed += kill_at_random(output).status == -1;
      expect_readable(output);
      const Outcome resumed = run(output);
      EXPECT_EQ(resumed.status, 0) << resumed.errors;
      EXPECT_EQ(without_times(read(folder_, output)), whole_);
      EXPECT_TRUE(read(folder_, output).run.complete);
      EXPECT_FALSE(std::filesystem::exists(folder_.path() / (output + ".unfinished")));
    }
    EXPECT_GT(killed, 0) << "moments are before the end";
  }

  /// Kill a run, then what goes on with it, and so on.
  void kill_again_and_again(int times) {
    for (int i = 0; i < times; ++i) {
      kill_at_random("again.json");
      expect_readable("again.json");
    }
    EXPECT_EQ(run("again.json").status, 0);
    EXPECT_EQ(without_times(read(folder_, "again.json")), whole_);
  }

  TemporaryFolder folder_;
  std::mt19937 moments_{20261128};
  Milliseconds whole_takes_{};
  std::string whole_;
};

TEST_F(KilledRun, EndsAsIfItHadNotBeen) { kill_and_resume(2); }

TEST_F(KilledRun, InThreePartsMakesTheWhole) {
  for (const std::string part : {"1", "2", "3"}) {
    kill_at_random(part + ".json", {"--shard", part + "/3"});
    EXPECT_EQ(run(part + ".json", {"--shard", part + "/3"}).status, 0);
  }
  const Outcome merged =
      run_program({"merge", "1.json", "2.json", "3.json", "-o", "merged.json"}, folder_.path());
  EXPECT_EQ(merged.status, 0) << merged.errors;
  EXPECT_EQ(without_times(read(folder_, "merged.json")), whole_);
}

/// Another count is another report.
TEST_F(KilledRun, IsComparedByAllThatWasCounted) {
  report::Report report = read(folder_, "whole.json");
  ++report.measurements.back().structure->nodes;
  EXPECT_NE(without_times(report), whole_);
  report = read(folder_, "whole.json");
  report.measurements.front().trace_ns.clear();
  EXPECT_NE(without_times(report), whole_) << "whether it was timed";
}

class LongKilledRun : public KilledRun {};

TEST_F(LongKilledRun, EndsAsIfItHadNotBeenTenTimes) { kill_and_resume(10); }
TEST_F(LongKilledRun, TenTimesInARow) { kill_again_and_again(10); }

}  // namespace
}  // namespace rayshoot::test
