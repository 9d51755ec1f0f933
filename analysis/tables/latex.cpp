#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <charconv>

#include "analysis/tables/latex_text.h"
#include "analysis/tables/page.h"

namespace rayshoot::analysis {

namespace {

/// Lines that a page has room for, and tables that LaTeX keeps waiting for a place.
constexpr std::size_t kPageLines = 44, kMostFloats = 12;
/// Longer texts are set in paragraphs; characters that surely fit into a line of these, and of a note.
constexpr std::size_t kLongText = 32, kParagraphLine = 26, kNoteLine = 85;

const std::string kRagged = "\\raggedright ";

bool is_number(const std::string& text) {
  double number = 0;
  const char *begin = text.data() + text.starts_with('+'), *end = text.data() + text.size();
  return std::from_chars(begin, end, number).ptr == end;
}

/// Numbers are set as mathematics, for a minus sign of their width and for powers of ten.
std::string cell(const std::string& text) {
  if (!is_number(text)) return latex_text(text);
  const std::size_t e = text.find('e');
  if (e == std::string::npos) return "$" + text + "$";
  return fmt::format("${} \\cdot 10^{{{}}}$", text.substr(0, e), text.substr(e + 1));
}

bool is_long(const Page& page, std::size_t column) {
  return page.columns[column].style == Style::text &&
         std::any_of(page.rows.begin(), page.rows.end(),
                     [&](const auto& row) { return display_width(row[column]) > kLongText; });
}

/// How the columns are set: words at the left, long ones in paragraphs, numbers at the right.
std::string column_styles(const Page& page) {
  std::string styles;
  for (std::size_t column = 0; column < page.columns.size(); ++column)
    styles += is_long(page, column)                       ? "p{0.4\\linewidth}"
              : page.columns[column].style == Style::text ? "l"
                                                          : "r";
  return styles;
}

/// In a ragged paragraph \\ ends a line of it, and \tabularnewline the row.
std::string line(const std::vector<std::string>& cells) {
  const bool ragged = cells.back().starts_with(kRagged);
  return fmt::format("{} {}\n", fmt::join(cells, " & "), ragged ? "\\tabularnewline" : "\\\\");
}

std::string row_of(const Page& page, const std::vector<std::string>& texts) {
  std::vector<std::string> cells;
  for (std::size_t column = 0; column < texts.size(); ++column)
    cells.push_back(is_long(page, column) ? kRagged + breakable_latex_text(texts[column])
                                          : cell(texts[column]));
  return line(cells);
}

/// Rows from `begin` to `end`, no wider than the text around them.
std::string body(const Page& page, std::size_t begin, std::size_t end) {
  std::vector<std::string> titles, units;
  for (const Column& column : page.columns)
    titles.push_back(latex_text(column.title)), units.push_back(latex_text(column.unit));
  std::string result = fmt::format(
      "\\resizebox{{\\ifdim\\width>\\linewidth\\linewidth\\else\\width\\fi}}{{!}}{{%\n"
      "\\begin{{tabular}}{{{}}}\n\\toprule\n",
      column_styles(page));
  result += line(titles) + line(units) + "\\midrule\n";
  for (std::size_t row = begin; row < end; ++row) result += row_of(page, page.rows[row]);
  return result + "\\bottomrule\n\\end{tabular}}\n";
}

std::size_t lines_of(const std::string& text, std::size_t width) {
  return std::max<std::size_t>(1, (display_width(text) + width - 1) / width);
}

std::size_t height_of(const Page& page, const std::vector<std::string>& row) {
  std::size_t lines = 1;
  for (std::size_t column = 0; column < row.size(); ++column)
    if (is_long(page, column)) lines = std::max(lines, lines_of(row[column], kParagraphLine));
  return lines;
}

/// A table in as many parts as it needs pages.
class Floats {
 public:
  explicit Floats(const Table& table) : title_(latex_text(table.title)) {
    if (const Page page = page_of(table); !page.columns.empty()) append(page);
    for (const std::string& note : table.notes)
      append(fmt::format("\n\\smallskip\\raggedright {}\n", breakable_latex_text(note)),
             lines_of(note, kNoteLine));
    if (parts_.empty()) parts_.emplace_back();
  }

  /// All parts, closed and with their captions.
  std::vector<std::string> parts() const {
    std::vector<std::string> result;
    for (const std::string& part : parts_)
      result.push_back(
          fmt::format("\\begin{{table}}\n\\centering\\footnotesize\\setlength{{\\tabcolsep}}{{4pt}}"
                      "\n\\caption{{{}{}}}\n{}\\end{{table}}\n",
                      title_, result.empty() ? "" : " (continued)", part));
    return result;
  }

 private:
  /// Text at the end of the last part, or of a new one where that has no room.
  void append(const std::string& text, std::size_t lines) {
    if (parts_.empty() || lines_ + lines > kPageLines) parts_.emplace_back(), lines_ = 0;
    parts_.back() += text;
    lines_ += lines;
  }

  void append(const Page& page) {
    std::size_t begin = 0, lines = 0;
    for (std::size_t row = 0; row < page.rows.size(); ++row) {
      const std::size_t more = height_of(page, page.rows[row]);
      if (lines + more > kPageLines) append(body(page, begin, row), lines), begin = row, lines = 0;
      lines += more;
    }
    if (begin < page.rows.size()) append(body(page, begin, page.rows.size()), lines);
  }

  std::string title_;
  std::vector<std::string> parts_;
  std::size_t lines_ = 0;
};

}  // namespace

std::string latex(const std::vector<Table>& tables) {
  std::string result = "% needs \\usepackage{booktabs,graphicx}\n";
  std::size_t waiting = 0;
  for (const Table& table : tables)
    for (const std::string& part : Floats(table).parts()) {
      if (++waiting % kMostFloats == 0) result += "\\clearpage\n";
      result += part;
    }
  const auto lines = legend(tables);
  if (lines.empty()) return result;
  result += "\\begin{description}\n";
  for (const auto& [title, meaning] : lines)
    result += fmt::format("\\item[{}] {}\n", latex_text(title), latex_text(meaning));
  return result + "\\end{description}\n";
}

}  // namespace rayshoot::analysis
