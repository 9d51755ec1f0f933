#include "scenes/core/spec.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace rayshoot {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::Pair;
using ::testing::ThrowsMessage;

TEST(ParseSpec, SplitsNameSizeFormAndArguments) {
  const Spec plain = parse_spec("balls");
  EXPECT_EQ(plain.name, "balls");
  EXPECT_EQ(plain.size + plain.form, "");
  EXPECT_TRUE(plain.arguments.empty());
  const Spec sized = parse_spec("balls:4/patches");
  EXPECT_EQ(sized.name, "balls");
  EXPECT_EQ(sized.size, "4");
  EXPECT_EQ(sized.form, "patches");
  EXPECT_THAT(parse_spec("grid(density=2, storage = dense)").arguments,
              ElementsAre(Pair("density", "2"), Pair("storage", "dense")));
}

TEST(ParseSpec, TakesArgumentsBeforeAndBehindTheForm) {
  for (const char* text : {"balls:4(tessellation=5)/patches", "balls:4/patches(tessellation=5)"}) {
    const Spec spec = parse_spec(text);
    EXPECT_EQ(spec.name, "balls") << text;
    EXPECT_EQ(spec.size, "4") << text;
    EXPECT_EQ(spec.form, "patches") << text;
    EXPECT_THAT(spec.arguments, ElementsAre(Pair("tessellation", "5"))) << text;
  }
}

TEST(ParseSpec, RefusesWhatIsNoSpecification) {
  for (const auto& [text, reason] :
       std::map<std::string, std::string>{{"", "the name is empty"},
                                          {":4", "the name is empty"},
                                          {"balls:", "nothing behind the colon"},
                                          {"balls/", "nothing behind the slash"},
                                          {"balls(size=4", "the parenthesis is not closed"},
                                          {"balls)(", "the parenthesis is not closed"},
                                          {"balls(size=4)x", "'x' behind the parenthesis"},
                                          {"balls(4)", "'4' is not key=value"},
                                          {"balls(size=4,size=5)", "'size' is given twice"}})
    EXPECT_THAT([&] { parse_spec(text); }, ThrowsMessage<InputError>(HasSubstr(reason))) << text;
}

TEST(Arguments, ChecksValuesAndFillsDefaults) {
  const std::vector<Parameter> parameters = {
      integer_parameter("size", 4, 1, 9, ""), real_parameter("ratio", 0.5, 0, 1, ""),
      boolean_parameter("fast", true, ""), choice_parameter("form", "curves", {"curves", "patches"}, "")};
  const Arguments arguments(parameters, {{"ratio", "1e-3"}, {"fast", "off"}}, "thing");
  EXPECT_EQ(arguments.integer("size"), 4);
  EXPECT_EQ(arguments.real("ratio"), 1e-3);
  EXPECT_FALSE(arguments.boolean("fast"));
  EXPECT_EQ(arguments.text("form"), "curves");
  for (const auto& [name, value] : std::map<std::string, std::string>{
           {"size", "0"}, {"ratio", "nan"}, {"fast", "yes"}, {"form", "curve"}})
    EXPECT_THAT(
        ([&, n = name, v = value] {
          Arguments(parameters, {{n, v}}, "thing");
        }),
        ThrowsMessage<InputError>(HasSubstr(fmt::format("thing: {}={} is not accepted", name, value))));
  EXPECT_THAT(([&] {
                Arguments(parameters, {{"sise", "1"}}, "thing");
              }),
              ThrowsMessage<InputError>(HasSubstr("unknown parameter 'sise'; did you mean 'size'?")));
}

TEST(Arguments, WriteValuesAsSpecificationsDo) {
  EXPECT_EQ(text_of(Arguments::Value(true)), "on");
  EXPECT_EQ(text_of(Arguments::Value(7ll)), "7");
  EXPECT_EQ(text_of(Arguments::Value(1000.0)), "1000");
  EXPECT_EQ(text_of(Arguments::Value(0.1)), "0.1");
}

}  // namespace
}  // namespace rayshoot
