#include <fmt/format.h>

#include <algorithm>
#include <numeric>

#include "analysis/tables/page.h"

namespace rayshoot::analysis {

namespace {

/// Names of rows are wrapped to no less than this.
constexpr std::size_t kLeastNameWidth = 12;

std::size_t widest(const Page& page, std::size_t column) {
  std::size_t width =
      std::max(display_width(page.columns[column].title), display_width(page.columns[column].unit));
  for (const auto& row : page.rows) width = std::max(width, display_width(row[column]));
  return width;
}

/// Widths of the columns, and of the gap between two: the names of rows give way where the page is too narrow.
struct Layout {
  std::vector<std::size_t> widths;
  std::size_t gap = 2;

  explicit Layout(const Page& page) {
    for (std::size_t column = 0; column < page.columns.size(); ++column)
      widths.push_back(widest(page, column));
    if (total() > kPageWidth) gap = 1;
    const std::size_t others = total() - widths[0];
    if (total() > kPageWidth) widths[0] = kPageWidth - std::min(others, kPageWidth - kLeastNameWidth);
  }

  std::size_t total() const {
    return std::accumulate(widths.begin(), widths.end(), gap * (widths.size() - 1));
  }

  /// A row: its name from the left, on as many lines as it needs, the others from the right.
  std::string line(const std::vector<std::string>& cells) const {
    const auto names = wrapped(cells[0], widths[0]);
    std::string result = names.empty() ? "" : names[0];
    std::size_t end = widths[0];
    for (std::size_t column = 1; column < cells.size(); ++column) {
      end += gap + widths[column];
      result.append(end - display_width(cells[column]) - display_width(result), ' ').append(cells[column]);
    }
    result.erase(result.find_last_not_of(' ') + 1);
    for (std::size_t i = 1; i < names.size(); ++i) result.append("\n").append(names[i]);
    return result + "\n";
  }
};

/// A paragraph whose lines but the first are indented.
std::string paragraph(const std::string& text, std::size_t indent) {
  std::string result;
  for (const std::string& line : wrapped(text, kPageWidth - indent))
    result += std::string(result.empty() ? 0 : indent, ' ') + line + "\n";
  return result;
}

/// Some columns of a page.
Page part_of(const Page& page, const std::vector<std::size_t>& columns) {
  const auto pick = [&](const auto& row) {
    std::decay_t<decltype(row)> picked;
    for (const std::size_t column : columns) picked.push_back(row[column]);
    return picked;
  };
  Page part{.columns = pick(page.columns)};
  for (const auto& row : page.rows) part.rows.push_back(pick(row));
  return part;
}

/// A page with more columns than fit side by side, in parts that each begin with the names of the rows.
std::vector<Page> parts_of(const Page& page) {
  std::vector<Page> parts;
  std::vector<std::size_t> columns{0};
  for (std::size_t column = 1; column < page.columns.size(); ++column) {
    columns.push_back(column);
    if (columns.size() == 2 || Layout(part_of(page, columns)).total() <= kPageWidth) continue;
    columns.pop_back();
    parts.push_back(part_of(page, columns));
    columns = {0, column};
  }
  parts.push_back(part_of(page, columns));
  return parts;
}

std::string body(const Page& page) {
  const Layout layout(page);
  std::vector<std::string> titles, units;
  for (const Column& column : page.columns) titles.push_back(column.title), units.push_back(column.unit);
  std::string result = "\n";
  result += layout.line(titles);
  if (std::any_of(units.begin(), units.end(), [](const auto& unit) { return !unit.empty(); }))
    result += layout.line(units);
  result += std::string(layout.total(), '-') + "\n";
  for (const auto& row : page.rows) result += layout.line(row);
  return result;
}

std::string section(const Table& table) {
  std::string result = paragraph(table.title, 2);
  if (!table.rows.empty())
    for (const Page& part : parts_of(page_of(table))) result += body(part);
  if (!table.notes.empty()) result += "\n";
  for (const std::string& note : table.notes) result += paragraph(note, 2);
  return result + "\n";
}

/// Titles, and beside them what they mean.
std::string legend_text(const std::vector<Explanation>& lines) {
  std::size_t width = 0;
  for (const auto& [title, meaning] : lines) width = std::max(width, display_width(title) + 2);
  std::string result;
  for (const auto& [title, meaning] : lines) {
    std::string beginning = title;
    for (const std::string& line : wrapped(meaning, kPageWidth - width)) {
      result += fmt::format("{:<{}}{}\n", beginning, width, line);
      beginning.clear();
    }
  }
  return result;
}

}  // namespace

std::string text(const std::vector<Table>& tables) {
  std::string result;
  for (const Table& table : tables) result += section(table);
  return result + legend_text(legend(tables));
}

}  // namespace rayshoot::analysis
