#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

/// One model of a table and its four renderings.
namespace rayshoot::analysis {

enum class Format { text, markdown, csv, latex };
inline const std::map<std::string, Format> kFormats{
    {"text", Format::text}, {"markdown", Format::markdown}, {"csv", Format::csv}, {"latex", Format::latex}};

/// Columns that a page or a terminal has.
inline constexpr std::size_t kPageWidth = 100;

/// number: three significant digits. whole: all digits. signed_percent: of a fraction, with its sign.
enum class Style { text, number, whole, signed_percent };

/// CSV is for programs: it has every column, while the others are for readers.
enum class Place { everywhere, csv, page };

struct Column {
  /// Name in CSV, with its unit.
  std::string key;
  std::string title, unit;
  /// One line of the legend; empty where the title says it all.
  std::string meaning;
  Style style = Style::number;
  Place place = Place::everywhere;
  /// Whether the largest values are the best ones, which stand first where rows are sorted by their mean.
  bool more_is_better = false;
};

/// A number, shown in the style of its column, or a text, shown in place of a number.
struct Cell {
  std::optional<double> number;
  std::string text;
};

inline Cell words(std::string text) { return {std::nullopt, std::move(text)}; }
inline Cell number(std::optional<double> value) { return {value, ""}; }
inline Cell whole(std::uint64_t value) { return {static_cast<double>(value), ""}; }
/// Of a fraction.
inline Cell percent(std::optional<double> fraction) {
  return {fraction ? std::optional(100 * *fraction) : fraction, ""};
}

/// Every row has a cell for each column. The first column of a page names the row.
struct Table {
  std::string title;
  std::vector<Column> columns;
  std::vector<std::vector<Cell>> rows;
  /// What a reader must know of single rows, below them.
  std::vector<std::string> notes;
};

/// Tables one below the other, and one legend for all of them. Text is at most `kPageWidth` columns wide. Columns
/// without a value in any row are left out, except in CSV, where numbers have full precision, missing ones are empty,
/// and tables of equal columns share one header.
std::string render(const std::vector<Table>& tables, Format format);

/// The same for one table.
std::string render(const Table& table, Format format);

}  // namespace rayshoot::analysis
