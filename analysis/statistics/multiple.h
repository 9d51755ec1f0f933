#pragma once

#include <span>
#include <vector>

/// Corrections for looking at a whole table: of a hundred cells in which nothing changed, five lie outside of their
/// 95 % intervals.
namespace rayshoot::analysis {

/// Chances adjusted after Holm (1979): refuse those of at most alpha, and the chance that even one of them is refused in
/// error is at most alpha, however the cells depend on each other.
std::vector<double> holm(std::span<const double> chances);

/// Chances adjusted after Benjamini and Hochberg (1995): refuse those of at most alpha, and of what is refused a part of
/// alpha is in error on average, for cells that are independent or positively dependent. Where nothing is to be refused
/// it errs as seldom as Holm, and where much is it finds more: nine repetitions have no chance below 1 in 48620, which
/// Holm multiplies by the number of cells.
std::vector<double> benjamini_hochberg(std::span<const double> chances);

}  // namespace rayshoot::analysis
