// What results/tables publishes, held against what its commands print from results/reports.
#include <fmt/format.h>
#include <gmock/gmock.h>

#include <filesystem>
#include <fstream>
#include <regex>
#include <set>
#include <sstream>

#include "program.h"

namespace rayshoot::test {
namespace {

const std::filesystem::path kTables = RAYSHOOT_SOURCE "/results/tables";
const std::filesystem::path kReports = RAYSHOOT_SOURCE "/results/reports";

std::string contents(const std::filesystem::path& path) {
  std::ostringstream text;
  text << std::ifstream(path).rdbuf();
  return text.str();
}

std::vector<std::string> words_of(const std::string& text) {
  std::istringstream stream(text);
  return {std::istream_iterator<std::string>(stream), {}};
}

/// Files that one command makes, and its words.
struct Row {
  std::vector<std::filesystem::path> files;
  std::vector<std::string> command;
};

/// The rows of the list, as harness/study reads them.
std::vector<Row> rows() {
  const std::string list = contents(kTables / "README.md");
  const std::regex row("\n\\| `([^`]*)` \\| `([^`]*)` \\| ");
  std::vector<Row> found;
  for (std::sregex_iterator match(list.begin(), list.end(), row), end; match != end; ++match) {
    const std::vector<std::string> names = words_of((*match)[1]);
    auto& files = found.emplace_back(Row{{names.at(0)}, words_of((*match)[2])}).files;
    for (std::size_t i = 1; i < names.size(); ++i)
      files.push_back(std::filesystem::path(names[0]).replace_extension(names[i]));
  }
  return found;
}

bool reports_are_there(const Row& row) {
  return std::all_of(row.command.begin(), row.command.end(), [](const std::string& word) {
    return !word.ends_with(".json") || std::filesystem::exists(kReports / word);
  });
}

std::string format_of(const std::filesystem::path& file) {
  return std::map<std::string, std::string>{
      {".md", "markdown"}, {".csv", "csv"}, {".tex", "latex"}, {".txt", "text"}}
      .at(file.extension());
}

TEST(PublishedTables, AreWhatTheirCommandsPrint) {
  std::size_t held = 0;
  for (const Row& row : rows()) {
    if (!reports_are_there(row)) continue;
    for (const std::filesystem::path& file : row.files) {
      std::vector<std::string> command = row.command;
      command.insert(command.end(), {"--format", format_of(file)});
      const Outcome printed = run_program(command, kReports);
      EXPECT_EQ(printed.status, 0) << printed.errors;
      // Not EXPECT_EQ: megabytes of a table would be told.
      EXPECT_TRUE(printed.output == contents(kTables / file)) << file << ": run harness/study";
      ++held;
    }
  }
  EXPECT_GE(held, 11u);
}

TEST(PublishedTables, HaveTheirRows) {
  std::set<std::string> listed{"README.md"}, there;
  for (const Row& row : rows())
    for (const std::filesystem::path& file : row.files) {
      const bool is_here = !file.has_parent_path();
      // What cannot be made is not published.
      if (is_here && reports_are_there(row)) listed.insert(file);
    }
  for (const auto& file : std::filesystem::directory_iterator(kTables)) there.insert(file.path().filename());
  EXPECT_EQ(there, listed);
}

}  // namespace
}  // namespace rayshoot::test
