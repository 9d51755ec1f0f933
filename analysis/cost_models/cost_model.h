#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "analysis/tables/groups.h"

namespace rayshoot::analysis {

/// What is thought of a constant before anything is measured, in models that are pooled.
struct Guess {
  double ns = 1;
  /// With how many measurements of a relative error of 1 it counts that the constant is what was guessed, and that techniques do
  /// not differ.
  double certain = 1e-3, alike = 0.3;
};

/// What one unit of a term costs, in nanoseconds.
struct Constant {
  std::string name;
  /// Whether every technique has its own, or all of a precision share it.
  bool of_technique = false;
  Guess guess{};
};

/// How the constants of a model are fitted that techniques have of their own and yet in common: the logarithm of each is that
/// of all techniques, plus what is this one's, plus what each circumstance of the cell adds to it in all techniques.
struct Pooling {
  /// What circumstances are called: "incoherent".
  std::vector<std::string> circumstances;
  /// How much of each there is in a cell, from 0 to 1.
  std::vector<double> (*amounts)(const Group& group, const Entry& entry) = nullptr;
  /// With how many measurements of a relative error of 1 it counts that circumstances do not matter.
  double indifferent = 0.01;
  /// Relative errors above this count by their length, not by their square.
  double robust = 0.15;
};

/// The tests that a model expects of a ray, for those that say so: these are held against what was counted.
struct ExpectedTests {
  /// Heading of a column of errors.
  std::string heading;
  std::optional<report::Predicted> (*of)(const report::Measurement& measurement) = nullptr;
  /// Whether they come from a sample of the rays: then they can be held against the rays that are not in it.
  bool of_sample = false;
};

/// A formula for the time of a ray: a sum of terms, each a number that the report holds times a constant of 0 or more
/// nanoseconds, which is fitted. Constants of models that are pooled are above 0.
struct CostModel {
  std::string id, title;
  /// In the words of its source: "T = C_IT N_IT + C_TS N_TS + C_0".
  std::string formula;
  std::string source;
  /// What must be so for the model to be right.
  std::string assumptions;
  /// One for each term.
  std::vector<Constant> constants;
  /// The terms of a cell, per ray; nothing where the model does not speak of it.
  std::optional<std::vector<double>> (*terms)(const Group& group, const Entry& entry) = nullptr;
  std::optional<ExpectedTests> tests{};
  std::optional<Pooling> pooling{};
};

/// A count of the cell's work per ray; 0 where it was not taken.
double counted(const Entry& entry, std::uint64_t report::Work::*count);
/// The terms of B E[n] + I E[m]: the expected tests of volumes and of objects; none where nothing is expected.
std::optional<std::vector<double>> test_terms(const std::optional<report::Predicted>& expected);

}  // namespace rayshoot::analysis

namespace rayshoot {

/// Every file of models/, sorted by name.
std::span<const analysis::CostModel* const> cost_models();

}  // namespace rayshoot
