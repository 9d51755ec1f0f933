#pragma once

#include <vector>

#include "analysis/compare/compare.h"
#include "analysis/tables/table.h"

namespace rayshoot::analysis {

/// A comparison for readers: in words, over all cells and technique by technique; the cells that changed, or `all_cells`;
/// the counts that changed. In CSV all cells and nothing else.
std::string render_compare(const Comparison& comparison, Format format, bool all_cells);

/// What the first of these says: "Of 125 cells: 2 slower, 0 faster, 1 with another count".
std::string in_words(const Comparison& comparison);

}  // namespace rayshoot::analysis
