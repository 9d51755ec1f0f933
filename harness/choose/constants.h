#pragma once

#include <map>
#include <string>
#include <vector>

namespace rayshoot {

/// What is known of one technique.
struct TechniqueConstants {
  /// Nanoseconds for each of its terms (terms.h).
  std::map<std::string, double> terms_ns;
  /// Time over that of the fastest candidate, at least and on geometric average over the cells that were fitted.
  double at_least = 1, on_average = 1;
  /// Root mean square of the relative error that the fit left.
  double error = 0;
};

/// What the terms of a ray's time cost, fitted to measurements.
struct Constants {
  /// Where and when they were measured, and on how many cells: combinations of scene and rays.
  std::string machine, date;
  std::uint64_t cells = 0;
  std::vector<std::string> scenes;
  /// Nanoseconds for each term that techniques share.
  std::map<std::string, double> object_terms_ns;
  /// By the id of the technique.
  std::map<std::string, TechniqueConstants> techniques;

  /// Null where the technique was not fitted.
  const TechniqueConstants* find(const std::string& technique) const;
  /// Nanoseconds that a ray is expected to take; `counts` by terms.
  double predicted_ns(const TechniqueConstants& technique, const std::map<std::string, double>& counts) const;
  /// "a processor, 2026-01-31, 18 cells".
  std::string origin() const;
};

/// Those that come with the program: harness/choose/constants.json.
const Constants& builtin_constants();

/// Read constants in JSON; `name` is named in messages. Throws InputError on anything that is not accepted.
Constants parse_constants(const std::string& text, const std::string& name);

/// The inverse.
std::string to_json(const Constants& constants);

}  // namespace rayshoot
