#include "harness/measure/timing.h"

#include <gmock/gmock.h>

#include <chrono>
#include <thread>

namespace rayshoot::test {
namespace {

using namespace std::chrono_literals;
using ::testing::Each;
using ::testing::Ge;
using ::testing::IsEmpty;
using ::testing::Lt;
using ::testing::SizeIs;

const auto never = [] { return false; };

TEST(TimingTest, EveryRepetitionHasATime) {
  int passes = 0;
  const auto times =
      time_interleaved({{.pass = [&] { ++passes, std::this_thread::sleep_for(2ms); }, .repetitions = 4},
                        {.pass = [] { std::this_thread::sleep_for(1ms); }, .repetitions = 2}},
                       never);
  ASSERT_THAT(times, SizeIs(2));
  EXPECT_EQ(passes, 4);
  EXPECT_THAT(times[0], SizeIs(4));
  EXPECT_THAT(times[0], Each(Ge(2e6)));
  EXPECT_THAT(times[1], SizeIs(2));
  EXPECT_THAT(times[1], Each(Ge(1e6)));
}

TEST(TimingTest, ShortPassesAreRepeatedAndTheirMeanIsTaken) {
  int passes = 0;
  const auto times = time_interleaved({{.pass = [&] { ++passes, std::this_thread::sleep_for(100us); },
                                        .repetitions = 3,
                                        .min_seconds = 0.005}},
                                      never);
  ASSERT_THAT(times.at(0), SizeIs(3));
  EXPECT_THAT(times[0], Each(Ge(1e5)));
  EXPECT_THAT(times[0], Each(Lt(5e6)));
  EXPECT_GT(passes, 3 * 5);
}

TEST(TimingTest, TidyingUpIsOffTheClock) {
  const auto times = time_interleaved(
      {{.pass = [] {}, .tidy_up = [] { std::this_thread::sleep_for(20ms); }, .repetitions = 3}}, never);
  ASSERT_THAT(times.at(0), SizeIs(3));
  EXPECT_THAT(times[0], Each(Lt(1e7)));
}

TEST(TimingTest, RepetitionsTakeTurns) {
  std::string order;
  time_interleaved({{.pass = [&] { order += 'a'; }, .repetitions = 20},
                    {.pass = [&] { order += 'b'; }, .repetitions = 20}},
                   never);
  EXPECT_THAT(order, SizeIs(40));
  EXPECT_NE(order.substr(0, 20), std::string(20, order[0]));
}

TEST(TimingTest, WhatIsStoppedHasTheTimesItGot) {
  int passes = 0;
  const auto times =
      time_interleaved({{.pass = [&] { ++passes; }, .repetitions = 10}}, [&] { return passes == 3; });
  EXPECT_THAT(times.at(0), SizeIs(3));
  EXPECT_THAT(time_interleaved({}, never), IsEmpty());
}

}  // namespace
}  // namespace rayshoot::test
