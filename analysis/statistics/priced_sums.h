#pragma once

#include <cstddef>
#include <span>
#include <utility>
#include <vector>

namespace rayshoot::analysis {

/// An amount times a price, exp(p1 x1 + p2 x2 ...), of unknowns x by their place in a list and powers p.
struct PricedAmount {
  double amount = 0;
  std::vector<std::pair<std::size_t, double>> powers;
};
using PricedSum = std::vector<PricedAmount>;

/// What an unknown is before anything is measured, and with how many measurements of a relative error of 1 that counts.
struct Belief {
  double value = 0, weight = 0;
};

/// Of amounts of 0 or more, one of them more than 0.
double value_of(const PricedSum& sum, std::span<const double> unknowns);

/// The unknowns for which sums come nearest to values above 0: the sum of the squares of log(sum / value), of which those
/// above `robust` count by their length alone (Huber 1964), and of weight (unknown - belief)^2 is least. One unknown for
/// each belief. Whatever the unknowns are, prices are above 0.
///
/// The method of Levenberg and Marquardt, from the beliefs; it ends at the nearest minimum.
std::vector<double> fit_priced_sums(std::span<const PricedSum> sums, std::span<const double> values,
                                    std::span<const Belief> beliefs, double robust);

}  // namespace rayshoot::analysis
