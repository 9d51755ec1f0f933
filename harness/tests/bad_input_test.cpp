#include <gmock/gmock.h>

#include <algorithm>

#include "program.h"

namespace rayshoot::test {
namespace {

using ::testing::HasSubstr;

struct BadInput {
  std::string name;
  std::vector<std::string> arguments;
  /// What the message must say.
  std::string message;

  friend void PrintTo(const BadInput& input, std::ostream* out) { *out << input.name; }
};

class BadInputTest : public ::testing::TestWithParam<BadInput> {};

TEST_P(BadInputTest, GivesOneLineAndStatusTwo) {
  const Outcome outcome = run_program(GetParam().arguments);
  EXPECT_EQ(outcome.status, 2);
  EXPECT_EQ(outcome.output, "");
  EXPECT_EQ(std::count(outcome.errors.begin(), outcome.errors.end(), '\n'), 1) << outcome.errors;
  EXPECT_THAT(outcome.errors, HasSubstr(GetParam().message));
}

INSTANTIATE_TEST_SUITE_P(
    Cases, BadInputTest,
    ::testing::Values(BadInput{"no_command", {}, "a command is required; known: "},
                      BadInput{"unknown_command", {"sceens"}, "did you mean 'scenes'?"},
                      BadInput{"unknown_option", {"scenes", "--jason"}, "did you mean '--json'?"},
                      BadInput{"extra_argument", {"techniques", "more"}, "one argument too many"}),
    [](const auto& instance) { return instance.param.name; });

}  // namespace
}  // namespace rayshoot::test
