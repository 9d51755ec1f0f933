#pragma once

#include <optional>
#include <span>

/// Whether two quantities put the same things in the same order: 1 when they do, -1 when the orders are opposite.
namespace rayshoot::analysis {

/// Spearman's rho: the correlation of the ranks, equal values sharing the mean of theirs. Nothing for fewer than two
/// pairs, or when one quantity is the same everywhere.
std::optional<double> spearman(std::span<const double> a, std::span<const double> b);

/// Kendall's tau b: pairs in the same order less those in opposite order, over the geometric mean of the pairs that are
/// not tied in one and in the other. Nothing where Spearman's rho is nothing.
std::optional<double> kendall(std::span<const double> a, std::span<const double> b);

}  // namespace rayshoot::analysis
