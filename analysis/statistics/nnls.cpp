#include "analysis/statistics/nnls.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

namespace rayshoot::analysis {

namespace {

using Vector = std::vector<double>;
using Matrix = std::vector<Vector>;

/// Less than this part of a column of length 1 stands for itself: others make it up.
constexpr double kIndependent = 1e-10;
/// A gradient below this part of the entries is 0.
constexpr double kZeroGradient = 1e-12;

bool well_formed(std::span<const Vector> rows, std::span<const double> values) {
  const auto finite = [](std::span<const double> numbers) {
    return std::all_of(numbers.begin(), numbers.end(), [](double number) { return std::isfinite(number); });
  };
  return !rows.empty() && rows.size() == values.size() && finite(values) &&
         std::all_of(rows.begin(), rows.end(),
                     [&](const Vector& row) { return row.size() == rows[0].size() && finite(row); });
}

/// Rows with columns of length 1, or 0 where they were.
struct Scaled {
  Matrix rows;
  Vector lengths;

  explicit Scaled(std::span<const Vector> given)
      : rows(given.begin(), given.end()), lengths(given[0].size(), 0) {
    for (const Vector& row : rows)
      for (std::size_t j = 0; j < row.size(); ++j) lengths[j] = std::hypot(lengths[j], row[j]);
    for (Vector& row : rows)
      for (std::size_t j = 0; j < row.size(); ++j)
        if (lengths[j] > 0) row[j] /= lengths[j];
  }
};

/// The normal equations: products of columns with each other and with the values.
struct Normal {
  Matrix products;
  Vector right;

  Normal(const Matrix& rows, std::span<const double> values)
      : products(rows[0].size(), Vector(rows[0].size(), 0)), right(rows[0].size(), 0) {
    for (std::size_t i = 0; i < rows.size(); ++i)
      for (std::size_t j = 0; j < right.size(); ++j) {
        right[j] += rows[i][j] * values[i];
        for (std::size_t k = 0; k < right.size(); ++k) products[j][k] += rows[i][j] * rows[i][k];
      }
  }

  /// How much faster the error falls with a column the more of it is taken.
  double gradient(std::size_t column, const Vector& x) const {
    return right[column] - std::inner_product(x.begin(), x.end(), products[column].begin(), 0.0);
  }

  /// The best coefficients of some columns, signs free, and 0 for all others; empty where they are dependent.
  Vector solve(const std::vector<std::size_t>& columns) const {
    const std::size_t n = columns.size();
    Matrix factor(n, Vector(n, 0));  // Cholesky's, lower
    for (std::size_t i = 0; i < n; ++i)
      for (std::size_t j = 0; j <= i; ++j) {
        double rest = products[columns[i]][columns[j]];
        for (std::size_t k = 0; k < j; ++k) rest -= factor[i][k] * factor[j][k];
        if (i == j && rest < kIndependent) return {};
        factor[i][j] = i == j ? std::sqrt(rest) : rest / factor[j][j];
      }
    Vector y(n);
    for (std::size_t i = 0; i < n; ++i) {
      y[i] = right[columns[i]];
      for (std::size_t k = 0; k < i; ++k) y[i] -= factor[i][k] * y[k];
      y[i] /= factor[i][i];
    }
    Vector x(right.size(), 0);
    for (std::size_t i = n; i-- > 0;) {
      for (std::size_t k = i + 1; k < n; ++k) y[i] -= factor[k][i] * x[columns[k]];
      x[columns[i]] = y[i] / factor[i][i];
    }
    return x;
  }
};

/// The column with the steepest gradient above `least`, of those that are not barred.
std::optional<std::size_t> steepest(const Normal& normal, const Vector& x, const std::vector<bool>& barred,
                                    double least) {
  std::optional<std::size_t> best;
  for (std::size_t j = 0; j < x.size(); ++j) {
    if (barred[j]) continue;
    if (const double gradient = normal.gradient(j, x); gradient > least) best = j, least = gradient;
  }
  return best;
}

/// Go from x towards z as far as nothing becomes negative; columns that become 0 are no longer taken.
void step_back(Vector& x, const Vector& z, std::vector<std::size_t>& taken) {
  const auto way_to_zero = [old = x, &z](std::size_t j) {
    return z[j] <= 0 ? old[j] / (old[j] - z[j]) : std::numeric_limits<double>::infinity();
  };
  double step = 1;
  for (const std::size_t j : taken) step = std::min(step, way_to_zero(j));
  for (const std::size_t j : taken) x[j] = way_to_zero(j) <= step ? 0 : x[j] + step * (z[j] - x[j]);
  std::erase_if(taken, [&](std::size_t j) { return way_to_zero(j) <= step; });
}

Vector active_set(const Normal& normal, double least_gradient) {
  const std::size_t columns = normal.right.size();
  Vector x(columns, 0);
  std::vector<std::size_t> taken;
  std::vector<bool> refused(columns, false);
  while (true) {
    // Take the column that helps most.
    std::vector<bool> barred = refused;
    for (const std::size_t j : taken) barred[j] = true;
    const auto column = steepest(normal, x, barred, least_gradient);
    if (!column) return x;
    taken.push_back(*column);
    Vector z = normal.solve(taken);
    // A column that others make up, or whose gradient was but rounding, is refused until something changes.
    if (z.empty() || z[*column] <= 0) {
      taken.pop_back();
      refused[*column] = true;
      continue;
    }
    // Give up columns until the best coefficients of the others are positive.
    while (std::any_of(taken.begin(), taken.end(), [&](std::size_t j) { return z[j] <= 0; })) {
      step_back(x, z, taken);
      z = normal.solve(taken);
    }
    x = std::move(z);
    std::fill(refused.begin(), refused.end(), false);
  }
}

double residual(std::span<const Vector> rows, std::span<const double> values, const Vector& x) {
  double length = 0;
  for (std::size_t i = 0; i < rows.size(); ++i)
    length = std::hypot(length, std::inner_product(x.begin(), x.end(), rows[i].begin(), -values[i]));
  return length;
}

}  // namespace

std::optional<NonNegativeFit> non_negative_least_squares(std::span<const Vector> rows,
                                                         std::span<const double> values) {
  if (!well_formed(rows, values)) return std::nullopt;
  const Scaled scaled(rows);
  const double size = std::sqrt(std::inner_product(values.begin(), values.end(), values.begin(), 0.0));
  Vector x = active_set(Normal(scaled.rows, values), kZeroGradient * size);
  for (std::size_t j = 0; j < x.size(); ++j)
    if (scaled.lengths[j] > 0) x[j] /= scaled.lengths[j];
  return NonNegativeFit{x, residual(rows, values, x)};
}

}  // namespace rayshoot::analysis
