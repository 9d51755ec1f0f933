#include "analysis/statistics/priced_sums.h"

#include <algorithm>
#include <cmath>

namespace rayshoot::analysis {

namespace {

constexpr int kMostRounds = 60, kMostTries = 8;
/// A round that gains less than this part of the objective is the last.
constexpr double kLeastGain = 1e-5;
/// No unknown moves farther in a round: a price by no more than a factor of e^2.
constexpr double kLongestStep = 2;
constexpr double kFirstDamping = 1e-3, kLeastDamping = 1e-6, kLessDamping = 0.2, kMoreDamping = 6;

double price_of(const PricedAmount& amount, std::span<const double> unknowns) {
  double exponent = 0;
  for (const auto& [unknown, power] : amount.powers) exponent += power * unknowns[unknown];
  return std::exp(exponent);
}

/// A symmetric system of normal equations, of which the lower half is kept.
class NormalEquations {
 public:
  explicit NormalEquations(std::size_t unknowns) : size_(unknowns), matrix_(size_ * size_), right_(size_) {}

  /// A row whose entries are 0 but for some, which are listed by place.
  void add(const std::vector<std::pair<std::size_t, double>>& row, double value, double weight) {
    for (const auto& [i, x] : row) {
      right_[i] += weight * x * value;
      for (const auto& [j, y] : row)
        if (j <= i) matrix_[i * size_ + j] += weight * x * y;
    }
  }

  /// The solution with a diagonal that is larger by a part of itself.
  std::vector<double> solved(double damping) const {
    std::vector<double> factor = matrix_;
    for (std::size_t i = 0; i < size_; ++i) factor[i * size_ + i] += damping * factor[i * size_ + i] + kTiny;
    factorize(factor);
    return substituted(factor);
  }

 private:
  static constexpr double kTiny = 1e-9;

  /// Cholesky's factor, in place, row by row.
  void factorize(std::vector<double>& factor) const {
    for (std::size_t i = 0; i < size_; ++i)
      for (std::size_t j = 0; j <= i; ++j) {
        double sum = factor[i * size_ + j];
        for (std::size_t k = 0; k < j; ++k) sum -= factor[i * size_ + k] * factor[j * size_ + k];
        factor[i * size_ + j] =
            i == j ? std::sqrt(std::max(sum, kTiny * kTiny)) : sum / factor[j * size_ + j];
      }
  }

  std::vector<double> substituted(const std::vector<double>& factor) const {
    std::vector<double> x = right_;
    for (std::size_t i = 0; i < size_; ++i) {
      for (std::size_t k = 0; k < i; ++k) x[i] -= factor[i * size_ + k] * x[k];
      x[i] /= factor[i * size_ + i];
    }
    for (std::size_t i = size_; i-- > 0;) {
      for (std::size_t k = i + 1; k < size_; ++k) x[i] -= factor[k * size_ + i] * x[k];
      x[i] /= factor[i * size_ + i];
    }
    return x;
  }

  std::size_t size_;
  std::vector<double> matrix_, right_;
};

/// What is to be made least.
struct Problem {
  std::span<const PricedSum> sums;
  std::span<const double> values;
  std::span<const Belief> beliefs;
  double robust;

  double error(std::size_t i, std::span<const double> unknowns) const {
    return std::log(value_of(sums[i], unknowns) / values[i]);
  }

  double objective(std::span<const double> unknowns) const {
    double sum = 0;
    for (std::size_t i = 0; i < sums.size(); ++i) {
      const double length = std::abs(error(i, unknowns));
      sum += length <= robust ? length * length : robust * (2 * length - robust);
    }
    for (std::size_t i = 0; i < beliefs.size(); ++i) {
      const double distance = unknowns[i] - beliefs[i].value;
      sum += beliefs[i].weight * distance * distance;
    }
    return sum;
  }

  /// How the logarithm of a sum grows with each unknown.
  std::vector<std::pair<std::size_t, double>> gradient(const PricedSum& sum,
                                                       std::span<const double> unknowns) const {
    std::vector<std::pair<std::size_t, double>> slopes;
    const double whole = value_of(sum, unknowns);
    for (const PricedAmount& amount : sum) {
      const double share = amount.amount * price_of(amount, unknowns) / whole;
      if (share == 0) continue;
      for (const auto& [unknown, power] : amount.powers) slopes.emplace_back(unknown, power * share);
    }
    return slopes;
  }

  NormalEquations linearized(std::span<const double> unknowns) const {
    NormalEquations equations(beliefs.size());
    for (std::size_t i = 0; i < sums.size(); ++i) {
      const double left = error(i, unknowns), length = std::abs(left);
      equations.add(gradient(sums[i], unknowns), -left, length <= robust ? 1 : robust / length);
    }
    for (std::size_t i = 0; i < beliefs.size(); ++i)
      equations.add({{i, 1}}, beliefs[i].value - unknowns[i], beliefs[i].weight);
    return equations;
  }
};

/// The way from the beliefs to the minimum.
class Descent {
 public:
  explicit Descent(const Problem& problem) : problem_(problem) {
    for (const Belief& belief : problem.beliefs) unknowns_.push_back(belief.value);
    objective_ = problem.objective(unknowns_);
  }

  std::vector<double> end() && {
    for (int round = 0; round < kMostRounds; ++round) {
      const double before = objective_;
      if (!advanced() || before - objective_ < kLeastGain * before) break;
    }
    return std::move(unknowns_);
  }

 private:
  /// Make a step that gains something; damp it until it does.
  bool advanced() {
    const NormalEquations equations = problem_.linearized(unknowns_);
    for (int tries = 0; tries < kMostTries; ++tries) {
      const std::vector<double> step = equations.solved(damping_);
      std::vector<double> next = unknowns_;
      for (std::size_t i = 0; i < next.size(); ++i)
        next[i] += std::clamp(step[i], -kLongestStep, kLongestStep);
      const double objective = problem_.objective(next);
      if (objective < objective_) {
        unknowns_ = std::move(next), objective_ = objective;
        damping_ = std::max(kLeastDamping, damping_ * kLessDamping);
        return true;
      }
      damping_ *= kMoreDamping;
    }
    return false;
  }

  const Problem& problem_;
  std::vector<double> unknowns_;
  double objective_ = 0, damping_ = kFirstDamping;
};

}  // namespace

double value_of(const PricedSum& sum, std::span<const double> unknowns) {
  double value = 0;
  for (const PricedAmount& amount : sum)
    if (amount.amount > 0) value += amount.amount * price_of(amount, unknowns);
  return value;
}

std::vector<double> fit_priced_sums(std::span<const PricedSum> sums, std::span<const double> values,
                                    std::span<const Belief> beliefs, double robust) {
  return Descent({sums, values, beliefs, robust}).end();
}

}  // namespace rayshoot::analysis
