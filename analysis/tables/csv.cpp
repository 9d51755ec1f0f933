#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "analysis/tables/page.h"

namespace rayshoot::analysis {

namespace {

/// RFC 4180: quotes around what holds a comma, a quote or an end of line, and quotes inside doubled.
std::string quoted(const std::string& text) {
  if (text.find_first_of(",\"\r\n") == std::string::npos) return text;
  std::string result = "\"";
  for (const char c : text) result += c == '"' ? "\"\"" : std::string(1, c);
  return result + "\"";
}

/// A number in as many digits as bring it back; a text only where texts stand.
std::string value(const Cell& cell, Style style) {
  if (cell.number) return fmt::format("{}", *cell.number);
  return style == Style::text ? quoted(cell.text) : "";
}

std::string header(const Table& table) {
  std::vector<std::string> keys;
  for (const Column& column : table.columns)
    if (column.place != Place::page) keys.push_back(quoted(column.key));
  return fmt::format("{}\n", fmt::join(keys, ","));
}

std::string line(const Table& table, const std::vector<Cell>& row) {
  std::vector<std::string> values;
  for (std::size_t i = 0; i < row.size(); ++i)
    if (table.columns[i].place != Place::page) values.push_back(value(row[i], table.columns[i].style));
  return fmt::format("{}\n", fmt::join(values, ","));
}

}  // namespace

std::string csv(const std::vector<Table>& tables) {
  std::string result, last_header;
  for (const Table& table : tables) {
    if (const std::string next = header(table); next != last_header) {
      result += (result.empty() ? "" : "\n") + next;
      last_header = next;
    }
    for (const auto& row : table.rows) result += line(table, row);
  }
  return result;
}

}  // namespace rayshoot::analysis
