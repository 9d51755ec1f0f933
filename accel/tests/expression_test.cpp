#include <gmock/gmock.h>

#include <random>

#include "accel/tests/expressions.h"

namespace rayshoot {
namespace {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

std::string text_of(std::string_view expression) { return parsed(expression).text(); }

/// The message of the error and the column, counted from 1, over which its caret stands.
std::pair<std::string, std::size_t> failure(std::string_view text) {
  try {
    parsed(text);
  } catch (const InputError& error) {
    const std::string message = error.what();
    EXPECT_THAT(message, HasSubstr("\n  " + std::string(text) + "\n  "));
    return {message.substr(0, message.find('\n')), message.size() - message.rfind('\n') - 3};
  }
  ADD_FAILURE() << text << " is accepted";
  return {};
}

TEST(Expressions, SequentialBindsTighterThanParallelAndBothGroupFromTheLeft) {
  const Expression mixed = parsed("uniform_grid|bvh_sah||hug|bvh_sah");
  ASSERT_EQ(mixed.kind, Expression::Kind::parallel);
  EXPECT_EQ(mixed.parts[0].kind, Expression::Kind::sequential);
  EXPECT_EQ(mixed.parts[1].kind, Expression::Kind::sequential);
  EXPECT_EQ(parsed("hug|hug|bvh_sah").parts[0].kind, Expression::Kind::sequential);
  EXPECT_EQ(parsed("hug|(hug|bvh_sah)").parts[1].kind, Expression::Kind::sequential);
  EXPECT_EQ(parsed("hug||hug||bvh_sah").parts[0].kind, Expression::Kind::parallel);
  EXPECT_EQ(parsed("hug|(hug||bvh_sah)").parts[1].kind, Expression::Kind::parallel);
}

TEST(Expressions, ReadTheirArguments) {
  const Expression grid = parsed(" sequential( uniform_grid(density = 2.5 ), hug, until=3, box=voxel ) ");
  EXPECT_EQ(grid.parts[0].arguments.real("density"), 2.5);
  EXPECT_EQ(grid.arguments.integer("until"), 3);
  EXPECT_EQ(grid.arguments.text("box"), "voxel");
  EXPECT_EQ(parsed("recursive(hug)").arguments.text("box"), "voxel");
  EXPECT_EQ(parsed("hug|hug").arguments.text("box"), "fit");
}

TEST(Expressions, AreWrittenInTheShortestForm) {
  EXPECT_EQ(text_of(" ( uniform_grid | ( bvh_sah ) ) "), "uniform_grid|bvh_sah");
  EXPECT_EQ(text_of("parallel(hug, sequential(hug,bvh_sah))"), "hug||hug|bvh_sah");
  EXPECT_EQ(text_of("hug|(hug|hug)"), "hug|(hug|hug)");
  EXPECT_EQ(text_of("(hug|hug)|hug"), "hug|hug|hug");
  EXPECT_EQ(text_of("hug|(hug||hug)"), "hug|(hug||hug)");
  EXPECT_EQ(text_of("sequential(hug,hug,until=2)||hug"), "sequential(hug,hug,until=2)||hug");
  for (const char* expression : kExpressions) EXPECT_EQ(text_of(text_of(expression)), text_of(expression));
}

TEST(Expressions, SayWhatTheyAreMadeOf) {
  const Expression expression = parsed("uniform_grid(density=2)|bvh_sah");
  const auto values = configuration(expression).values();
  EXPECT_EQ(std::get<double>(values.at("2.density")), 2);
  EXPECT_EQ(std::get<std::string>(values.at("1.box")), "fit");
  EXPECT_TRUE(values.contains("3.max_objects"));
  const TechniqueEntry entry = compose(expression);
  EXPECT_EQ(entry.info.id, "uniform_grid(density=2)|bvh_sah");
  EXPECT_THAT(entry.info.events,
              ElementsAre("level_0_steps", "level_0_candidates", "level_1_steps", "level_1_candidates"));
}

TEST(Expressions, FailWithACaretUnderTheColumn) {
  using Failure = std::pair<std::string_view, std::pair<const char*, std::size_t>>;
  for (const auto& [text, expected] : std::initializer_list<Failure>{
           {"uniform_grid|", {"a technique is expected", 14}},
           {"|uniform_grid", {"a technique is expected", 1}},
           {"hug||", {"a technique is expected", 6}},
           {"hug|||hug", {"a technique is expected", 6}},
           {"hug|octre_samet", {"did you mean 'octree_samet'?", 5}},
           {"hug|recursiv(hug)", {"did you mean 'recursive'?", 5}},
           {"hug|(hug|hug", {"a closing parenthesis is expected", 13}},
           {"hug|hug)", {"an operator | or || or the end is expected", 8}},
           {"hug hug", {"an operator | or || or the end is expected", 5}},
           {"hug|uniform_grid(densty=2)", {"did you mean 'density'?", 18}},
           {"hug|uniform_grid(density=no)", {"density takes", 18}},
           {"hug|uniform_grid(density)", {"an equals sign is expected", 25}},
           {"hug|uniform_grid(density=2,density=3)", {"'density' is given twice", 28}},
           {"hug|uniform_grid(density=2", {"a comma or a closing parenthesis is expected", 27}},
           {"recursive(hug,depth=2)", {"unknown parameter 'depth'", 15}},
           {"recursive hug", {"an opening parenthesis is expected", 11}},
           {"sequential(hug)", {"a comma and the next part is expected", 15}},
           {"parallel(hug,hug,until=2)", {"unknown parameter 'until'", 18}},
           {"hug||bvh_kay_kajiya|hug", {"bvh_kay_kajiya is not based on spatial indexing", 6}},
           {"(hug||hug)|hug", {"hug||hug is not based on spatial indexing", 1}},
           {"recursive(exhaustive)", {"exhaustive is not based on spatial indexing", 11}},
       }) {
    const auto [message, column] = failure(text);
    EXPECT_THAT(message,
                AllOf(HasSubstr(expected.first), HasSubstr("column " + std::to_string(expected.second))));
    EXPECT_EQ(column, expected.second) << text;
  }
  EXPECT_THAT(failure(std::string(100, '(')).first, HasSubstr("parentheses in one another"));
}

/// Whatever is typed is an expression, which is the same when it is written and read again, or an error.
TEST(Expressions, AnyTextIsReadOrRefused) {
  constexpr const char* kPieces[] = {"hug",        "uniform_grid",
                                     "bvh_sah",    "exhaustive",
                                     "recursive",  "sequential",
                                     "parallel",   "until",
                                     "density",    "box",
                                     "voxel",      "|",
                                     "||",         "(",
                                     ")",          ",",
                                     "=",          "2",
                                     " ",          "\t",
                                     "-",          "\xc3\xa9",
                                     "1e9",        "\n",
                                     "(hug|hug)",  "until=2",
                                     "max_depth=1"};
  std::mt19937_64 random(7);
  constexpr int kTexts = 1'000'000;
  int read = 0;
  const auto technique_names = technique_entries();
  for (int i = 0; i < kTexts; ++i) {
    std::string text;
    for (auto pieces = random() % 12; pieces > 0; --pieces) text += kPieces[random() % std::size(kPieces)];
    if (i % 4 == 0)
      for (char& c : text)
        if (random() % 8 == 0) c = static_cast<char>(random() % 256);
    try {
      const Expression expression = parse_expression(text, technique_names);
      ASSERT_EQ(text_of(expression.text()), expression.text()) << text;
      ++read;
    } catch (const InputError& error) {
      ASSERT_THAT(error.what(), HasSubstr("column "));
    }
  }
  EXPECT_GT(read, kTexts / 1000);
}

}  // namespace
}  // namespace rayshoot
