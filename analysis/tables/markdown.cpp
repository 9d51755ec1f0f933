#include <fmt/format.h>
#include <fmt/ranges.h>

#include "analysis/tables/page.h"

namespace rayshoot::analysis {

namespace {

/// A text of one line in which nothing is markup.
std::string escaped(const std::string& text) {
  std::string result;
  for (const char c : text) {
    if (std::string_view("\\`*_[]<>|#&~$").find(c) != std::string_view::npos) result += '\\';
    result += c == '\n' || c == '\r' ? ' ' : c;
  }
  return result;
}

std::string line(const std::vector<std::string>& cells) {
  return fmt::format("| {} |\n", fmt::join(cells, " | "));
}

std::string body(const Page& page) {
  std::vector<std::string> titles, rules;
  for (const Column& column : page.columns) {
    titles.push_back(
        escaped(column.unit.empty() ? column.title : fmt::format("{} ({})", column.title, column.unit)));
    rules.push_back(rules.empty() ? ":--" : "--:");
  }
  std::string result = line(titles) + line(rules);
  for (const auto& row : page.rows) {
    std::vector<std::string> cells;
    for (const std::string& cell : row) cells.push_back(escaped(cell));
    result += line(cells);
  }
  return result + "\n";
}

}  // namespace

std::string markdown(const std::vector<Table>& tables) {
  std::string result;
  for (const Table& table : tables) {
    result += fmt::format("### {}\n\n", escaped(table.title));
    if (!table.rows.empty()) result += body(page_of(table));
    for (const std::string& note : table.notes) result += fmt::format("- {}\n", escaped(note));
    if (!table.notes.empty()) result += "\n";
  }
  for (const auto& [title, meaning] : legend(tables))
    result += fmt::format("- **{}**: {}\n", escaped(title), escaped(meaning));
  return result;
}

}  // namespace rayshoot::analysis
