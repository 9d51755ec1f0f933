#pragma once

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "analysis/tables/page.h"

namespace rayshoot::analysis {

/// The names of a table's rows, from above.
inline std::vector<std::string> row_names(const Table& table) {
  std::vector<std::string> names;
  for (const auto& row : table.rows) names.push_back(row[0].text);
  return names;
}

/// The cell of a row, by its number, and of a column; an empty one and a failure where there is none.
inline Cell cell_in_row(const Table& table, std::size_t row, const std::string& key) {
  const auto column =
      std::find_if(table.columns.begin(), table.columns.end(), [&](const Column& c) { return c.key == key; });
  if (row < table.rows.size() && column != table.columns.end())
    return table.rows[row][static_cast<std::size_t>(column - table.columns.begin())];
  ADD_FAILURE() << fmt::format("no cell {} in row {} of {}", key, row, table.title);
  return {};
}
inline double number_in_row(const Table& table, std::size_t row, const std::string& key) {
  return cell_in_row(table, row, key).number.value_or(0);
}

/// The cell of a row, by its name, and of a column; an empty one and a failure where there is none.
inline Cell find_cell(const Table& table, const std::string& name, const std::string& key) {
  const auto row = std::find_if(table.rows.begin(), table.rows.end(),
                                [&](const auto& cells) { return cells[0].text == name; });
  return cell_in_row(table, static_cast<std::size_t>(row - table.rows.begin()), key);
}

/// The number in a cell, which must have one.
inline double number_in(const Table& table, const std::string& name, const std::string& key) {
  const Cell cell = find_cell(table, name, key);
  EXPECT_TRUE(cell.number) << name << " has no " << key;
  return cell.number.value_or(0);
}

}  // namespace rayshoot::analysis
