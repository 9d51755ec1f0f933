#include <fmt/format.h>
#include <gmock/gmock.h>

#include <cmath>
#include <fstream>
#include <sstream>

#include "analysis/tables/comparison.h"
#include "analysis/tables/latex_text.h"
#include "analysis/tables/page.h"
#include "analysis/tables/table.h"
#include "analysis/tests/small_report.h"

namespace rayshoot::analysis {
namespace {

using ::testing::Each;
using ::testing::ElementsAre;
using ::testing::EndsWith;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;
using ::testing::SizeIs;

std::string golden(const std::string& name) {
  std::ifstream file(fmt::format("{}/{}", RAYSHOOT_TEST_DATA, name));
  EXPECT_TRUE(file) << name << " is missing";
  std::ostringstream text;
  text << file.rdbuf();
  return text.str();
}

std::vector<std::string> split(const std::string& text, char separator) {
  std::vector<std::string> parts;
  std::istringstream stream(text);
  for (std::string part; std::getline(stream, part, separator);) parts.push_back(part);
  return parts;
}

std::string small(Format format) { return render_comparison({small_report()}, format); }

TEST(Golden, Text) { EXPECT_EQ(small(Format::text), golden("small_report.txt")); }
TEST(Golden, Markdown) { EXPECT_EQ(small(Format::markdown), golden("small_report.md")); }
TEST(Golden, Latex) { EXPECT_EQ(small(Format::latex), golden("small_report.tex")); }

/// The last digits of a ratio are those of the machine's logarithm.
void expect_equal_fields(const std::string& actual, const std::string& expected, const std::string& name) {
  char* end = nullptr;
  const double number = std::strtod(expected.c_str(), &end);
  if (expected.empty() || *end != '\0')
    EXPECT_EQ(actual, expected) << name;
  else
    EXPECT_NEAR(std::stod(actual), number, 1e-12 * std::abs(number)) << name;
}

TEST(Golden, Csv) {
  const std::string text = small(Format::csv), recorded = golden("small_report.csv");
  const auto lines = split(text, '\n'), expected = split(recorded, '\n');
  ASSERT_EQ(lines.size(), expected.size()) << text;
  EXPECT_EQ(lines[0], expected[0]);
  const auto names = split(lines[0], ',');
  for (std::size_t line = 1; line < lines.size(); ++line) {
    // Appended, for a last field that is empty.
    const auto fields = split(lines[line] + ",;", ','), wanted = split(expected[line] + ",;", ',');
    ASSERT_EQ(fields.size(), names.size() + 1) << lines[line];
    ASSERT_EQ(wanted.size(), fields.size()) << text;
    for (std::size_t i = 0; i < names.size(); ++i) expect_equal_fields(fields[i], wanted[i], names[i]);
  }
}

TEST(Significant, HasThreeDigits) {
  EXPECT_EQ(significant(0), "0");
  EXPECT_EQ(significant(1), "1.00");
  EXPECT_EQ(significant(-12.34), "-12.3");
  EXPECT_EQ(significant(0.00123), "0.00123");
  EXPECT_EQ(significant(0.000999), "9.99e-4");
  EXPECT_EQ(significant(9.999), "10.0");
  EXPECT_EQ(significant(99.96), "100");
  EXPECT_EQ(significant(123456), "123456");
  EXPECT_EQ(significant(999999.5), "1.00e6");
  EXPECT_EQ(significant(1.8446744073709552e19), "1.84e19");
  EXPECT_EQ(significant(-4.9e-324), "-4.94e-324");
}

TEST(Wrapped, BreaksAtSpacesAndLongWordsAfterPunctuation) {
  EXPECT_THAT(wrapped("one two  three", 7), ElementsAre("one two", "three"));
  EXPECT_THAT(wrapped("bvh_goldsmith_salmon", 17), ElementsAre("bvh_goldsmith_", "salmon"));
  EXPECT_THAT(wrapped("a_goldsmithsalmon", 8), ElementsAre("a_goldsm", "ithsalmo", "n"));
  EXPECT_THAT(wrapped("ééééé", 2), ElementsAre("éé", "éé", "é"));
  EXPECT_THAT(wrapped("", 5), IsEmpty());
}

/// A table with one column of numbers.
Table numbers(std::vector<Cell> cells) {
  Table table{.title = "title", .columns = {technique_column(), {"key", "number", "unit", "meaning"}}};
  for (Cell& cell : cells) table.rows.push_back({{std::nullopt, "row"}, std::move(cell)});
  return table;
}

TEST(Pages, LeaveOutColumnsWithoutAValueAndTheirMeaning) {
  EXPECT_THAT(page_of(numbers({{}, {}})).columns, SizeIs(1));
  EXPECT_THAT(page_of(numbers({{}, {2, ""}})).columns, SizeIs(2));
  EXPECT_THAT(legend({numbers({{}})}), IsEmpty());
  EXPECT_THAT(legend({numbers({{}, {2, ""}}), numbers({{1, ""}})}), SizeIs(1));
}

TEST(Pages, ShowNumbersInTheStyleOfTheirColumn) {
  Table table = numbers({{0.25, ""}, {-1.125, ""}, {1234567, ""}, {}, {1, "WRONG"}});
  const auto shown = [&](Style style) {
    table.columns[1].style = style;
    std::vector<std::string> texts;
    for (const auto& row : page_of(table).rows) texts.push_back(row[1]);
    return texts;
  };
  EXPECT_THAT(shown(Style::number), ElementsAre("0.250", "-1.12", "1.23e6", "-", "WRONG"));
  EXPECT_THAT(shown(Style::whole), ElementsAre("0", "-1", "1234567", "-", "WRONG"));
  EXPECT_THAT(shown(Style::signed_percent), ElementsAre("+25.0", "-112", "+1.23e8", "-", "WRONG"));
}

/// Every line of a text, which must not end in a space nor be wider than a page.
std::vector<std::string> lines_of_page(const std::string& text) {
  const auto lines = split(text, '\n');
  for (const std::string& line : lines) EXPECT_LE(display_width(line), kPageWidth) << line;
  EXPECT_THAT(lines, Each(Not(EndsWith(" "))));
  return lines;
}

TEST(Width, OfTheSmallReport) { lines_of_page(small(Format::text)); }

TEST(Width, WithLongNamesScenesAndReasons) {
  report::Report report = small_report();
  const std::string path = "/" + std::string(90, 'p') + "/" + std::string(150, 'q') + ".obj";
  report.scenes[0].id = path;
  report.ray_sets[0].id = path + "/whitted@9";
  for (report::Measurement& m : report.measurements) {
    m.scene = path, m.rays = path + "/whitted@9";
    m.technique += "|" + std::string(130, 'x');
    m.config["a_key_of_some_length"] = m.trace_ns.empty() ? 0.1234567890123 : m.trace_ns[0];
    m.config["another"] = m.technique;
  }
  report.left_out[0].why = std::string(40, 'w') + " " + std::string(230, 'y') + " " + std::string(70, 'z');
  lines_of_page(render_comparison({report}, Format::text));
}

/// Numbers of which each needs all the columns it can.
report::Report extreme_report() {
  report::Report report = small_report();
  constexpr std::uint64_t most = std::numeric_limits<std::uint64_t>::max();
  for (report::Measurement& m : report.measurements) {
    m.work = report::Work{1, most, most, most, most, most, most, most};
    m.strict_work = m.work;
    m.predicted = report::Predicted{1.23e-300, 1.23e-300};
    m.efficiency = report::Efficiency{1.23e-300, {0, 1}, 1.23e-300, {0, 1}};
    m.structure = report::Structure{most, most, most, most, most, most};
    m.build_ns = {1.23e-300};
    if (!m.trace_ns.empty()) m.trace_ns = {m.technique == kZeroOverhead ? 1.23e-300 : 1.23e300};
  }
  return report;
}

TEST(Width, WithExtremeNumbers) {
  const auto lines = lines_of_page(render_comparison({extreme_report()}, Format::text));
  EXPECT_THAT(lines, ::testing::Contains(HasSubstr("1.84e19")));
}

TEST(Width, OfATableInPartsShowsEveryColumnBesideTheNames) {
  Table table{.title = "title", .columns = {technique_column()}, .rows = {{{std::nullopt, "the_name"}}}};
  for (int i = 10; i < 40; ++i) {
    table.columns.push_back({fmt::format("key{}", i), fmt::format("column{}", i)});
    table.rows[0].push_back({1000.0 + i, ""});
  }
  const std::string shown = render(table, Format::text);
  lines_of_page(shown);
  for (int i = 10; i < 40; ++i) {
    EXPECT_THAT(shown, HasSubstr(fmt::format("column{}", i)));
    EXPECT_THAT(shown, HasSubstr(fmt::format("10{}", i)));
  }
  std::size_t names = 0;
  for (const std::string& line : split(shown, '\n')) names += line.starts_with("the_name  ");
  EXPECT_EQ(names, 3u);
}

TEST(Text, IndentsNotesAndStartsTheLegendOnce) {
  Table table = numbers({{2, ""}});
  table.notes = {std::string(60, 'a') + " " + std::string(60, 'b')};
  EXPECT_EQ(
      render({table, table}, Format::text),
      fmt::format("title\n\ntechnique  number\n             unit\n-----------------\nrow          2.00\n\n"
                  "{0}\n  {1}\n\ntitle\n\ntechnique  number\n             unit\n-----------------\n"
                  "row          2.00\n\n{0}\n  {1}\n\nnumber  meaning\n",
                  std::string(60, 'a'), std::string(60, 'b')));
}

/// A table whose every text is the same.
Table texts(const std::string& text) {
  return {.title = text,
          .columns = {{"key", text, text, text, Style::text}},
          .rows = {{{std::nullopt, text}}},
          .notes = {text}};
}

TEST(Latex, EscapesWhatWouldBeACommand) {
  const std::string text = "\\a~b^c<d>e&f%g$h#i_j{k}l|m\n\nn", shown = render(texts(text), Format::latex);
  const std::string escaped =
      "\\textbackslash{}a\\textasciitilde{}b\\textasciicircum{}c\\textless{}d\\textgreater{}e\\&f\\%g\\$h\\#"
      "i\\_"
      "j\\{k\\}l\\textbar{}m  n";
  EXPECT_THAT(shown, HasSubstr("\\caption{" + escaped + "}\n"));
  EXPECT_THAT(shown, HasSubstr("\\toprule\n" + escaped + " \\\\\n" + escaped + " \\\\\n\\midrule\n" +
                               escaped + " \\\\\n\\bottomrule"));
  EXPECT_THAT(shown, HasSubstr("\\raggedright " + breakable_latex_text(text) + "\n"));
  EXPECT_THAT(shown, HasSubstr("\\item[" + escaped + "] " + escaped + "\n"));
}

TEST(Latex, SetsNumbersAsMathematics) {
  const std::string shown = render(numbers({{-1.5, ""}, {1.23e-7, ""}, {1, "3 < 4"}, {}}), Format::latex);
  EXPECT_THAT(shown, HasSubstr("row & $-1.50$ \\\\"));
  EXPECT_THAT(shown, HasSubstr("row & $1.23 \\cdot 10^{-7}$ \\\\"));
  EXPECT_THAT(shown, HasSubstr("row & 3 \\textless{} 4 \\\\"));
  EXPECT_THAT(shown, HasSubstr("row & - \\\\"));
}

TEST(Markdown, EscapesWhatWouldBeMarkup) {
  const std::string shown = render(texts("\\a`b*c_d[e]f<g>h|i#j&k~l$m\nn"), Format::markdown);
  const std::string escaped = "\\\\a\\`b\\*c\\_d\\[e\\]f\\<g\\>h\\|i\\#j\\&k\\~l\\$m n";
  EXPECT_EQ(shown,
            fmt::format("### {0}\n\n| {0} ({0}) |\n| :-- |\n| {0} |\n\n- {0}\n\n- **{0}**: {0}\n", escaped));
}

TEST(Csv, QuotesAsRfc4180Says) {
  const auto field = [](const std::string& text) { return render(texts(text), Format::csv); };
  EXPECT_EQ(field("plain; text"), "key\nplain; text\n");
  EXPECT_EQ(field("a,b"), "key\n\"a,b\"\n");
  EXPECT_EQ(field("say \"b\""), "key\n\"say \"\"b\"\"\"\n");
  EXPECT_EQ(field("two\nlines"), "key\n\"two\nlines\"\n");
  EXPECT_EQ(field("two\rlines"), "key\n\"two\rlines\"\n");
}

TEST(Csv, HasNumbersInFullAndNoWordsAmongThem) {
  EXPECT_EQ(render(numbers({{1.0 / 3, ""}, {}, {std::nullopt, "WRONG"}, {1e300, ""}}), Format::csv),
            "key\n0.3333333333333333\n\n\n1e+300\n");
}

TEST(Csv, TablesOfEqualColumnsShareAHeader) {
  const Table table = numbers({{2, ""}});
  Table other = table;
  other.columns[1].key = "other";
  EXPECT_EQ(render({table, table, other}, Format::csv), "key\n2\n2\n\nother\n2\n");
}

}  // namespace
}  // namespace rayshoot::analysis
