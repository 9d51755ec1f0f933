#pragma once

#include <gtest/gtest.h>

#include <fstream>
#include <nlohmann/json.hpp>

#include "scenes/tests/aggregates.h"

/// The aggregates of the original programs' scenes, under keys "scene/s<size>/<c or t>": curves or tessellated.
namespace rayshoot::test {

/// A reference file's object as lists of numbers: nested objects get dotted names, nested arrays are
/// flattened.
inline void flatten(const nlohmann::json& value, const std::string& name,
                    std::map<std::string, std::vector<double>>& lists) {
  if (value.is_object())
    for (const auto& [key, member] : value.items())
      flatten(member, name.empty() ? key : name + "." + key, lists);
  else if (value.is_array())
    for (const nlohmann::json& element : value) flatten(element, name, lists);
  else if (value.is_number())
    lists[name].push_back(value.get<double>());
}

/// How far a regenerated quantity may lie from its reference: 1e-9 of its value. A sum whose summands cancel
/// has no correct digits to compare: each summand carries a rounding error of a few ulps (1e-16 of itself),
/// errors of n summands add up to far less than n times that, and 1e-13 of the sum of magnitudes bounds them
/// for the n of these scenes, while a misplaced, missing or reordered object changes such a sum by at least
/// 1e-7 of it.
inline double tolerance(const std::string& name, double reference, double magnitude) {
  if (name == "min_edge") return 5e-6 * reference;  // recorded with six digits
  if (name == "max_nonplanarity") return 1e-13;     // nothing but rounding error
  return 1e-9 * std::abs(reference) + 1e-13 * magnitude;
}

inline void expect_equal(const std::string& name, const std::vector<Quantity>& ours,
                         const std::vector<double>& reference) {
  // What a scene has none of, nobody summed: it counts as zero.
  for (std::size_t i = 0; i < std::max(ours.size(), reference.size()); ++i) {
    const Quantity quantity = i < ours.size() ? ours[i] : Quantity();
    const double expected = i < reference.size() ? reference[i] : 0;
    EXPECT_NEAR(quantity.value, expected, tolerance(name, expected, quantity.magnitude))
        << name << "[" << i << "]";
  }
}

inline nlohmann::json read_reference() {
  std::ifstream file(RAYSHOOT_SOURCE "/scenes/tests/data/spd_aggregates.json");
  return nlohmann::json::parse(file);
}

inline std::vector<std::string> reference_keys() {
  const nlohmann::json reference = read_reference();
  std::vector<std::string> keys;
  for (const auto& [key, aggregates] : reference.items()) keys.push_back(key);
  return keys;
}

/// Hold the aggregates of a scene against all of those under a key.
inline void expect_reference(const std::string& key, Aggregates ours) {
  std::map<std::string, std::vector<double>> reference;
  flatten(read_reference().at(key), "", reference);
  ASSERT_GE(reference.size(), 50u);
  for (const auto& [name, numbers] : reference) expect_equal(name, ours[name], numbers);
  for (const auto& [name, quantities] : ours)
    EXPECT_TRUE(reference.contains(name)) << name << " is not in the reference";
}

}  // namespace rayshoot::test
