#include "analysis/tables/page.h"

#include <fmt/format.h>

#include <algorithm>
#include <sstream>

namespace rayshoot::analysis {

namespace {

std::string shown(const Cell& cell, Style style) {
  if (!cell.text.empty()) return cell.text;
  if (!cell.number) return "-";
  if (style == Style::whole) return fmt::format("{:.0f}", *cell.number);
  if (style == Style::number) return significant(*cell.number);
  const std::string percent = significant(100 * *cell.number);
  return *cell.number < 0 ? percent : "+" + percent;
}

bool has_value(const Cell& cell) { return cell.number || !cell.text.empty(); }

bool is_shown(const Table& table, std::size_t column) {
  return table.columns[column].place != Place::csv &&
         std::any_of(table.rows.begin(), table.rows.end(),
                     [&](const auto& row) { return has_value(row[column]); });
}

/// Bytes of UTF-8 that continue a character begun before.
bool continues_character(char byte) { return (static_cast<unsigned char>(byte) & 0xC0) == 0x80; }

/// Cut the first `width` columns off a text that is longer, or fewer where punctuation ends in their second half.
std::string cut(std::string& text, std::size_t width) {
  std::size_t end = 0, columns = 0;
  while (end < text.size() && (columns < width || continues_character(text[end])))
    columns += !continues_character(text[end++]);
  const std::size_t mark = text.find_last_of("_(,;/|", end - 1);
  if (mark != std::string::npos && mark >= end / 2) end = mark + 1;
  std::string head = text.substr(0, end);
  text.erase(0, end);
  return head;
}

}  // namespace

std::string significant(double number) {
  const std::string rounded = fmt::format("{:.2e}", number);
  const std::size_t e = rounded.find('e');
  if (number == 0 || e == std::string::npos) return fmt::format("{}", number);
  const int exponent = std::stoi(rounded.substr(e + 1));
  if (exponent < -3 || exponent > 5) return fmt::format("{}e{}", rounded.substr(0, e), exponent);
  return fmt::format("{:.{}f}", number, std::max(0, 2 - exponent));
}

std::size_t display_width(const std::string& text) {
  return static_cast<std::size_t>(
      std::count_if(text.begin(), text.end(), [](char byte) { return !continues_character(byte); }));
}

std::vector<std::string> wrapped(const std::string& text, std::size_t width) {
  std::vector<std::string> lines;
  std::istringstream words(text);
  for (std::string word; words >> word;) {
    const bool fits = !lines.empty() && display_width(lines.back()) + 1 + display_width(word) <= width;
    if (fits) word = lines.back() + " " + word, lines.pop_back();
    while (display_width(word) > width) lines.push_back(cut(word, width));
    lines.push_back(word);
  }
  return lines;
}

Page page_of(const Table& table) {
  Page page;
  std::vector<std::size_t> columns;
  for (std::size_t column = 0; column < table.columns.size(); ++column)
    if (is_shown(table, column)) columns.push_back(column);
  for (const std::size_t column : columns) page.columns.push_back(table.columns[column]);
  for (const auto& row : table.rows) {
    auto& texts = page.rows.emplace_back();
    for (const std::size_t column : columns) texts.push_back(shown(row[column], table.columns[column].style));
  }
  return page;
}

std::vector<Explanation> legend(const std::vector<Table>& tables) {
  std::vector<Explanation> lines;
  for (const Table& table : tables)
    for (const Column& column : page_of(table).columns) {
      const bool known = std::any_of(lines.begin(), lines.end(), [&](const Explanation& line) {
        return line.title == column.title && line.meaning == column.meaning;
      });
      if (!known && !column.meaning.empty()) lines.push_back({column.title, column.meaning});
    }
  return lines;
}

std::string render(const std::vector<Table>& tables, Format format) {
  switch (format) {
    case Format::text:
      return text(tables);
    case Format::markdown:
      return markdown(tables);
    case Format::latex:
      return latex(tables);
    case Format::csv:
      break;
  }
  return csv(tables);
}

std::string render(const Table& table, Format format) { return render(std::vector{table}, format); }

}  // namespace rayshoot::analysis
