#pragma once

#include <optional>
#include <span>
#include <vector>

namespace rayshoot::analysis {

/// A linear model with coefficients of 0 or more.
struct NonNegativeFit {
  /// One for each column; exactly 0 where a negative one would have fitted better.
  std::vector<double> coefficients;
  /// Length of what is left over: || A x - b ||.
  double residual = 0;
};

/// The coefficients x >= 0 that make || A x - b || least, for the rows of A and the entries of b. To weigh a row,
/// multiply it and its entry by a weight: by 1 / b for relative errors. A column that is 0, or that others make
/// up, has the coefficient 0. Nothing without rows, where rows have different lengths or where a number is not finite.
///
/// The active set method of Lawson and Hanson, Solving Least Squares Problems, 1974, chapter 23. It solves
/// normal equations with columns scaled to length 1, which is good for the few columns of a cost model.
std::optional<NonNegativeFit> non_negative_least_squares(std::span<const std::vector<double>> rows,
                                                         std::span<const double> values);

}  // namespace rayshoot::analysis
