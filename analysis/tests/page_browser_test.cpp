// The page as validators and browsers see it, where they are installed. That it is well-formed, escaped and needs no other
// file is tested without them, in report_page_test.cpp.
#include <fmt/format.h>
#include <gmock/gmock.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <regex>
#include <sstream>

#include "analysis/html/report_page.h"
#include "analysis/tests/small_report.h"

namespace rayshoot::analysis {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

bool is_installed(const std::string& program) {
  return std::system(fmt::format("command -v {} >/dev/null 2>&1", program).c_str()) == 0;
}

/// A folder that is gone at the end of its scope, and what programs say there.
class Folder {
 public:
  Folder() {
    std::string name = (std::filesystem::temp_directory_path() / "rayshoot_page_XXXXXX").string();
    if (!mkdtemp(name.data())) throw std::runtime_error("no temporary folder");
    path_ = name;
  }
  ~Folder() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }
  Folder(const Folder&) = delete;

  std::filesystem::path write(const std::string& name, const std::string& text) const {
    std::ofstream(path_ / name) << text;
    return path_ / name;
  }
  std::string read(const std::string& name) const {
    std::ostringstream text;
    text << std::ifstream(path_ / name).rdbuf();
    return text.str();
  }
  int run(const std::string& command) const {
    return std::system(
        fmt::format("cd '{}' && {} >output 2>errors </dev/null", path_.string(), command).c_str());
  }

 private:
  std::filesystem::path path_;
};

/// A report with everything on its page.
std::string full_page() {
  report::Report report = small_report();
  for (report::Measurement& cell : report.measurements)
    cell.errors =
        report::Errors{1000, {{"exact", 990}, {"wrong_object", 10}}, report::Ulps{0.5, 1, 2, 3}, {}};
  report.run.command = "rayshoot run 'a & b' <c>";
  return report_page({report}, {{"a_picture", "\x89PNG\r\n\x1a\n"}}).html;
}

TEST(PageValidation, TidyHasNothingToSay) {
  if (!is_installed("tidy")) GTEST_SKIP() << "tidy is not installed";
  const Folder folder;
  folder.write("page.html", full_page());
  EXPECT_EQ(folder.run("tidy -q -e page.html"), 0) << folder.read("errors");
  EXPECT_EQ(folder.read("errors"), "");
  folder.write("page.html", full_page() + "<div></p>");
  EXPECT_NE(folder.run("tidy -q -e page.html"), 0);
}

TEST(PageValidation, TheNuValidatorHasNothingToSay) {
  if (!is_installed("vnu")) GTEST_SKIP() << "vnu is not installed";
  const Folder folder;
  folder.write("page.html", full_page());
  EXPECT_EQ(folder.run("vnu page.html"), 0) << folder.read("errors");
}

/// A script that sorts the first table by its second column, and says how wide the page is, and its window, and what
/// stands in the column.
constexpr const char* kProbe = R"(<script>
document.querySelectorAll("table.sortable thead th")[1].click();
const column = [...document.querySelector("table.sortable").tBodies[0].rows].map(row => row.cells[1].textContent);
parent.postMessage(
  [document.documentElement.scrollWidth, document.documentElement.clientWidth, column.join(" ")].join("|"), "*");
</script>)";

/// What Chromium says of a page as wide as that, with what the probe found.
struct Seen {
  std::string title, errors;
  bool printed = false;
};

Seen seen_in_chromium(const std::string& page, int width) {
  const Folder folder;
  folder.write("page.html", page);
  // Windows are at least 500 wide: the page is looked at in a frame.
  const auto file = folder.write(
      "frame.html",
      fmt::format("<!DOCTYPE html><title>none</title>"
                  "<script>addEventListener('message', event => {{document.title = event.data}})</script>"
                  "<iframe src=\"page.html\" style=\"width:{}px;height:800px;border:0\"></iframe>",
                  width));
  const std::string chromium =
      "chromium --headless=new --no-sandbox --disable-gpu --user-data-dir=profile --enable-logging=stderr "
      "--window-size=1400,900 --virtual-time-budget=3000";
  folder.run(fmt::format("{} --dump-dom file://{}", chromium, file.string()));
  Seen seen{.errors = folder.read("errors")};
  const std::string document = folder.read("output");
  std::smatch title;
  if (std::regex_search(document, title, std::regex("<title>([^<]*)</title>"))) seen.title = title[1];
  folder.run(fmt::format("{} --print-to-pdf=page.pdf file://{}", chromium,
                         file.parent_path().string() + "/page.html"));
  seen.printed = folder.read("page.pdf").starts_with("%PDF");
  return seen;
}

class LongPage : public ::testing::TestWithParam<int> {};

TEST_P(LongPage, OpensInABrowser) {
  if (!is_installed("chromium")) GTEST_SKIP() << "chromium is not installed";
  const Seen seen = seen_in_chromium(full_page() + kProbe, GetParam());
  EXPECT_THAT(seen.errors, Not(HasSubstr("CONSOLE")));
  EXPECT_TRUE(seen.printed);
  std::istringstream fields(seen.title);
  int page_width = 0, window_width = 0;
  char bar;
  fields >> page_width >> bar >> window_width;
  EXPECT_NEAR(window_width, GetParam(), 15) << "but for a scroll bar: " << seen.title;
  EXPECT_EQ(page_width, window_width) << "nothing sticks out at the side";
  EXPECT_THAT(seen.title, HasSubstr("|12.0 5.00 3.00 0.600 - - -")) << "sorted by tests per ray";
}

INSTANTIATE_TEST_SUITE_P(Widths, LongPage, ::testing::Values(1280, 400));

TEST(LongPageProbe, SeesWhatIsWrong) {
  if (!is_installed("chromium")) GTEST_SKIP() << "chromium is not installed";
  const Seen seen = seen_in_chromium(
      full_page() + "<div style=\"width:3000px\">wide</div><script>nothing();</script>" + kProbe, 1280);
  EXPECT_THAT(seen.errors, HasSubstr("CONSOLE"));
  EXPECT_THAT(seen.title, HasSubstr("30"));
}

}  // namespace
}  // namespace rayshoot::analysis
