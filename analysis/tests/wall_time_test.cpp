#include "analysis/tables/wall_time.h"

#include <gtest/gtest.h>

namespace rayshoot::analysis {
namespace {

TEST(WallTime, NamesTheShareOfTheTimedWorkAndThenTheRestByItsShare) {
  report::Run run;
  run.phase_seconds = {{"trace", 26}, {"build", 4},  {"verify", 3},
                       {"count", 7},  {"hash", 0.1}, {"other", 0.9}};
  EXPECT_EQ(wall_time(run),
            "timed work 73 % of 41.0 s (trace 63 %, build 10 %); count 17 %, verify 7 %, other 2 %");
}

TEST(WallTime, IsWellWhereNothingIsTimed) {
  report::Run run;
  run.phase_seconds = {{"count", 2}};
  EXPECT_EQ(wall_time(run), "timed work 0 % of 2.00 s; count 100 %");
  run.phase_seconds = {{"trace", 2}};
  EXPECT_EQ(wall_time(run), "timed work 100 % of 2.00 s (trace 100 %)");
}

TEST(WallTime, IsSilentOnReportsThatDoNotTell) {
  EXPECT_EQ(wall_time({}), "");
  report::Run run;
  run.phase_seconds = {{"trace", 0}};
  EXPECT_EQ(wall_time(run), "");
}

}  // namespace
}  // namespace rayshoot::analysis
