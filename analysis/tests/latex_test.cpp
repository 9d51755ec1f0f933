// Tables in LaTeX: what TeX would stumble over is looked for always, and TeX itself is asked where it is installed.
#include <fmt/format.h>
#include <gmock/gmock.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <regex>
#include <sstream>

#include "analysis/tables/comparison.h"
#include "analysis/tables/latex_text.h"
#include "analysis/tests/small_report.h"

namespace rayshoot::analysis {
namespace {

using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;

/// Every character that has a meaning to TeX, every one that its fonts do not have, and words without an end.
const std::string kHostile =
    "[\\a~b^c] {d}_e$f$ %g#h &i *j --k ``l'' \"m\" <n>|o "
    "\x01\x7f é² ⁻⁹ µs × · » → ≤ κ Δ ð ł 中文 😀 \u00a0 "
    "a_word_without_an_end_that_goes_on_and_on_and_on_and_on_and_on_and_on_and_on_and_on_and_on_and_on_and_"
    "on";

report::Report hostile_report() {
  report::Report report = small_report();
  report.run.id = kHostile;
  report.scenes[0].id = report.ray_sets[0].scene = kHostile;
  report.ray_sets[0].id = kHostile + "/" + kHostile;
  for (report::Measurement& cell : report.measurements) {
    cell.scene = kHostile;
    cell.rays = report.ray_sets[0].id;
    if (cell.technique == "uniform_grid") cell.config[kHostile] = kHostile + cell.technique;
    if (cell.technique == "bvh_sah") cell.technique = kHostile;
    if (cell.verdict.message) cell.verdict.message = kHostile;
  }
  for (report::LeftOutCell& cell : report.left_out) cell.technique = cell.why = kHostile;
  return report;
}

/// A report whose table is longer than a page.
report::Report long_report() {
  report::Report report = small_report();
  for (int i = 0; i < 100; ++i) {
    report::Measurement cell = report.measurements[1];
    cell.config["density"] = 2.0 + i;
    report.measurements.push_back(cell);
  }
  return report;
}

/// A report of more tables than TeX keeps waiting.
report::Report wide_report() {
  report::Report report = small_report();
  for (int i = 0; i < 30; ++i) {
    report.ray_sets.push_back(report.ray_sets[0]);
    report.ray_sets.back().id = fmt::format("balls:2/curves/whitted@{}", 10 + i);
    for (const report::Measurement& cell : small_report().measurements) {
      report.measurements.push_back(cell);
      report.measurements.back().rays = report.ray_sets.back().id;
    }
  }
  return report;
}

std::string latex_of(const std::vector<report::Report>& reports) {
  return render_comparison(reports, Format::latex);
}

/// What TeX would stumble over: braces and environments that are not closed, rows of other lengths than their tables,
/// characters that no font has, and more floats than wait between two pages.
std::vector<std::string> faults(const std::string& tex) {
  std::vector<std::string> found, open;
  std::size_t columns = 0, floats = 0;
  std::istringstream lines(tex);
  for (std::string line; std::getline(lines, line);) {
    if (line.starts_with("%")) continue;
    if (std::regex_search(line, std::regex("[^\x20-\x7e\xc3\x80-\xbf]")))
      found.push_back("character: " + line);
    const std::string bare = std::regex_replace(line, std::regex("\\\\[\\\\{}&%$#_]"), "");
    const auto count = [&](char c) { return std::count(bare.begin(), bare.end(), c); };
    std::smatch match;
    if (std::regex_search(line, match, std::regex("\\\\begin\\{(\\w+)\\}"))) open.push_back(match[1]);
    if (std::regex_search(line, match, std::regex("\\\\begin\\{tabular\\}\\{(.*)\\}$"))) {
      const std::string styles = std::regex_replace(match[1].str(), std::regex("p\\{[^}]*\\}"), "l");
      columns = styles.size();
    } else if (line.ends_with("\\\\") || line.ends_with("\\tabularnewline")) {
      if (static_cast<std::size_t>(count('&')) + 1 != columns) found.push_back("columns: " + line);
    }
    if (count('{') != count('}') && !line.starts_with("\\resizebox") && line != "\\end{tabular}}")
      found.push_back("braces: " + line);
    if (count('$') % 2 != 0) found.push_back("mathematics: " + line);
    if (std::regex_search(line, match, std::regex("\\\\end\\{(\\w+)\\}"))) {
      if (open.empty() || open.back() != match[1].str()) return {"environment: " + line};
      open.pop_back();
      floats += match[1] == "table";
    }
    if (line == "\\clearpage") floats = 0;
    if (floats > 17) found.push_back("too many floats");
  }
  found.insert(found.end(), open.begin(), open.end());
  return found;
}

TEST(LatexText, NamesWhatFontsDoNotHave) {
  EXPECT_EQ(latex_text("10⁻⁹ µs × é"), "10$^-$$^9$ $\\mu$s $\\times$ é");
  EXPECT_EQ(latex_text("中 ð"), "U+4E2D U+00F0");
  EXPECT_EQ(latex_text("---a"), "-{}-{}-a") << "hyphens are no dashes";
  EXPECT_EQ(latex_text("[1]"), "{[}1{]}") << "no option of \\\\ nor of \\item";
  EXPECT_EQ(breakable_latex_text("a_b"), "a\\_\\allowbreak{}b");
}

TEST(Latex, HasNothingThatTexStumblesOver) {
  for (const report::Report& report : {small_report(), hostile_report(), long_report(), wide_report()})
    EXPECT_THAT(faults(latex_of({report})), IsEmpty());
  EXPECT_THAT(faults(latex_of({hostile_report(), small_report()})), IsEmpty());
}

TEST(Latex, HasFaultsWhereItShould) {
  for (const char* tex : {"\\begin{table}\n", "{a\n", "中\n", "a$b\n", "\x01\n", "\\end{table}\n",
                          "\\begin{tabular}{lr}\na \\\\\n\\end{tabular}}\n"})
    EXPECT_THAT(faults(tex), Not(IsEmpty())) << tex;
  std::string many;
  for (int i = 0; i < 18; ++i) many += "\\begin{table}\n\\end{table}\n";
  EXPECT_THAT(faults(many), Not(IsEmpty()));
}

TEST(Latex, GoesOnOnTheNextPage) {
  const std::string tex = latex_of({long_report()});
  EXPECT_THAT(tex, HasSubstr("100 rays (continued)}"));
  EXPECT_THAT(latex_of({small_report()}), Not(HasSubstr("(continued)")));
}

bool has_pdflatex() { return std::system("pdflatex --version >/dev/null 2>&1") == 0; }

/// What TeX says that it does not like in a document of these tables; nothing where it likes all.
std::string complaints(const std::string& tables) {
  std::string name = (std::filesystem::temp_directory_path() / "rayshoot_latex_XXXXXX").string();
  if (!mkdtemp(name.data())) return "no temporary folder";
  const std::filesystem::path folder = name;
  std::ofstream(folder / "t.tex")
      << "\\documentclass{article}\n\\usepackage{booktabs,graphicx}\n\\begin{document}\n"
      << tables << "\\end{document}\n";
  const int status = std::system(
      fmt::format("cd '{}' && pdflatex -interaction=nonstopmode -halt-on-error t.tex >out 2>&1 </dev/null",
                  name)
          .c_str());
  std::string text;
  std::ifstream log(folder / "t.log");
  for (std::string line; std::getline(log, line);)
    if (line.starts_with("!") || line.find("too large for page") != std::string::npos ||
        line.starts_with("Overfull \\hbox"))
      text += line + "\n";
  std::filesystem::remove_all(folder);
  return status == 0 ? text : text + "no document";
}

TEST(Latex, Compiles) {
  if (!has_pdflatex()) GTEST_SKIP() << "pdflatex is not installed";
  EXPECT_EQ(complaints(latex_of({small_report()})), "");
  EXPECT_EQ(complaints(latex_of({long_report()})), "");
  EXPECT_EQ(complaints(latex_of({wide_report()})), "");
  const std::string of_hostile = complaints(latex_of({hostile_report(), small_report()}));
  EXPECT_THAT(of_hostile, Not(HasSubstr("!")));
  EXPECT_NE(complaints("\\begin{tabular}{l} \\toprul \\end{tabular}"), "");
}

/// All reports of the project, page by page.
TEST(LongLatex, ReportsOfTheProjectCompile) {
  if (!has_pdflatex()) GTEST_SKIP() << "pdflatex is not installed";
  for (const auto& file :
       std::filesystem::directory_iterator(std::filesystem::path(RAYSHOOT_SOURCE) / "results/reports"))
    if (file.path().extension() == ".json") {
      EXPECT_EQ(complaints(latex_of({report::read_report(file.path().string())})), "") << file.path();
    }
}

}  // namespace
}  // namespace rayshoot::analysis
