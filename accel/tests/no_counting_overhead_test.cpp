// Timed code is free of counting: callgrind counts the instructions of a technique's timed loop, and of the same
// algorithm written out by hand without a counter policy (counting_probe.cpp).

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>

namespace rayshoot {
namespace {

class NoCountingOverhead : public ::testing::TestWithParam<const char*> {
 protected:
  void SetUp() override {
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
    GTEST_SKIP() << "sanitizers do not run under valgrind";
#elif !defined(__OPTIMIZE__)
    GTEST_SKIP() << "without optimisation no abstraction is free";
#endif
    if (std::system("valgrind --version >/dev/null 2>&1") != 0) GTEST_SKIP() << "valgrind is not installed";
  }

  /// Instructions executed in `function` of the probe and in all that it calls.
  static double instructions(const std::string& technique, const std::string& function) {
    const auto file =
        std::filesystem::temp_directory_path() / fmt::format("rayshoot_callgrind_{}_{}", getpid(), technique);
    const std::string command = fmt::format(
        "valgrind --tool=callgrind --toggle-collect={} --callgrind-out-file='{}' '{}' {} >/dev/null 2>&1",
        function, file.string(), RAYSHOOT_COUNTING_PROBE, technique);
    EXPECT_EQ(std::system(command.c_str()), 0) << command;
    double total = 0;
    std::ifstream lines(file);
    for (std::string line; std::getline(lines, line);)
      if (line.starts_with("totals:")) total = std::stod(line.substr(7));
    std::filesystem::remove(file);
    EXPECT_GT(total, 1e6) << command;
    return total;
  }
};

TEST_P(NoCountingOverhead, TimedLoopsExecuteWhatALoopByHandDoes) {
  const double timed = instructions(GetParam(), "probe_timed");
  EXPECT_NEAR(timed / instructions(GetParam(), "probe_uncountable"), 1, 0.001);
  // Without the engine the compiler spends registers in another way.
  EXPECT_NEAR(timed / instructions(GetParam(), "probe_plain"), 1, 0.03);
  EXPECT_GT(instructions(GetParam(), "probe_counted") / timed, 1.1) << "counting should show";
}

INSTANTIATE_TEST_SUITE_P(Techniques, NoCountingOverhead, ::testing::Values("exhaustive", "bvh_sah"),
                         [](const auto& technique) { return std::string(technique.param); });

}  // namespace
}  // namespace rayshoot
