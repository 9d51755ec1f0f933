#pragma once

#include "analysis/tables/table.h"

/// What the renderings for readers share.
namespace rayshoot::analysis {

/// About three significant digits: 123456, 123, 12.3, 1.23, 0.00123, 1.23e-5; at most 9 characters and a sign.
std::string significant(double number);

/// Columns a text takes on a terminal.
std::size_t display_width(const std::string& text);

/// Lines of at most `width` columns, broken at spaces, and inside words that are longer than a line.
/// Every white space counts as one space.
std::vector<std::string> wrapped(const std::string& text, std::size_t width);

/// A table as a reader sees it: columns that have a value, every cell a text, "-" where there is none.
struct Page {
  std::vector<Column> columns;
  std::vector<std::vector<std::string>> rows;
};

Page page_of(const Table& table);

/// A line of the legend: a title and what it means.
struct Explanation {
  std::string title, meaning;
};

/// What the columns of all tables mean, each once.
std::vector<Explanation> legend(const std::vector<Table>& tables);

std::string text(const std::vector<Table>& tables);
std::string markdown(const std::vector<Table>& tables);
std::string latex(const std::vector<Table>& tables);
std::string csv(const std::vector<Table>& tables);

}  // namespace rayshoot::analysis
