#pragma once

#include <span>
#include <vector>

/// Corrections for looking at a whole table: of a hundred cells in which nothing changed, five lie outside of their
/// 95 % intervals.
namespace rayshoot::analysis {

/// Chances adjusted after Holm (1979): refuse those of at most alpha, and the chance that even one of them is refused in
/// error is at most alpha, however the cells depend on each other. For gates.
std::vector<double> holm(std::span<const double> chances);

/// Chances adjusted after Benjamini and Hochberg (1995): refuse those of at most alpha, and of what is refused a part of
/// alpha is in error on average, for cells that are independent or positively dependent. For a search through many.
std::vector<double> benjamini_hochberg(std::span<const double> chances);

}  // namespace rayshoot::analysis
