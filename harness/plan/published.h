#pragma once

#include <map>
#include <string>
#include <vector>

namespace rayshoot {

/// What somebody published about a technique on a scene.
struct PublishedRow {
  std::string scene;
  /// Specification of the technique with the parameters that stand for theirs.
  std::string technique;
  /// What they call it.
  std::string label;
  /// Their figures, by the names of `figure_names`.
  std::map<std::string, double> figures{};
};

/// What somebody wrote about two techniques on a scene, by specification.
struct PublishedClaim {
  std::string scene, first, second;
  /// "faster": the first is the faster one. "similar": neither is faster by more than `kSimilarTimes`.
  std::string relation;
};

inline constexpr double kSimilarTimes = 1.5;

struct Published {
  std::string source;
  std::vector<PublishedRow> rows;
  std::vector<PublishedClaim> claims;
};

/// What figures there are: counts of the structure, work per ray (see `figure_of`), and work in all.
const std::vector<std::string>& figure_names();

/// Read published figures in JSON; `name` is named in messages. Throws InputError on anything that is not accepted.
Published parse_published(const std::string& text, const std::string& name);

/// Those that come with the program under that name; throws InputError when there are none.
Published load_published(const std::string& name);

}  // namespace rayshoot
