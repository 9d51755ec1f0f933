#include <fmt/format.h>
#include <fmt/ranges.h>

#include <charconv>

#include "analysis/tables/page.h"

namespace rayshoot::analysis {

namespace {

/// A text of one paragraph in which nothing is a command.
std::string escaped(const std::string& text) {
  std::string result;
  for (const char c : text) {
    if (c == '\\')
      result += "\\textbackslash{}";
    else if (c == '~')
      result += "\\textasciitilde{}";
    else if (c == '^')
      result += "\\textasciicircum{}";
    else if (c == '<')
      result += "\\textless{}";
    else if (c == '>')
      result += "\\textgreater{}";
    else if (c == '|')
      result += "\\textbar{}";
    else if (c == '\n' || c == '\r')
      result += ' ';
    else if (std::string_view("&%$#_{}").find(c) != std::string_view::npos)
      result += std::string("\\") + c;
    else
      result += c;
  }
  return result;
}

bool is_number(const std::string& text) {
  double number = 0;
  const char *begin = text.data() + text.starts_with('+'), *end = text.data() + text.size();
  return std::from_chars(begin, end, number).ptr == end;
}

/// Numbers are set as mathematics, for a minus sign of their width and for powers of ten.
std::string cell(const std::string& text) {
  if (!is_number(text)) return escaped(text);
  const std::size_t e = text.find('e');
  if (e == std::string::npos) return "$" + text + "$";
  return fmt::format("${} \\cdot 10^{{{}}}$", text.substr(0, e), text.substr(e + 1));
}

std::string line(const std::vector<std::string>& cells) {
  return fmt::format("{} \\\\\n", fmt::join(cells, " & "));
}

std::string body(const Page& page) {
  std::vector<std::string> titles, units;
  for (const Column& column : page.columns)
    titles.push_back(escaped(column.title)), units.push_back(escaped(column.unit));
  std::string result =
      fmt::format("\\begin{{tabular}}{{l{}}}\n\\toprule\n", std::string(page.columns.size() - 1, 'r'));
  result += line(titles) + line(units) + "\\midrule\n";
  for (const auto& row : page.rows) {
    std::vector<std::string> cells;
    for (const std::string& text : row) cells.push_back(cell(text));
    result += line(cells);
  }
  return result + "\\bottomrule\n\\end{tabular}\n";
}

}  // namespace

std::string latex(const std::vector<Table>& tables) {
  std::string result = "% needs \\usepackage{booktabs}\n";
  for (const Table& table : tables) {
    result +=
        fmt::format("\\begin{{table}}\n\\centering\\footnotesize\n\\caption{{{}}}\n", escaped(table.title));
    if (!table.rows.empty()) result += body(page_of(table));
    for (const std::string& note : table.notes) result += fmt::format("\n\\raggedright {}\n", escaped(note));
    result += "\\end{table}\n";
  }
  const auto lines = legend(tables);
  if (lines.empty()) return result;
  result += "\\begin{description}\n";
  for (const auto& [title, meaning] : lines)
    result += fmt::format("\\item[{}] {}\n", escaped(title), escaped(meaning));
  return result + "\\end{description}\n";
}

}  // namespace rayshoot::analysis
