#include "analysis/cost_models/tested_objects.h"

namespace rayshoot::analysis {

namespace {

/// Vertices of a polygon where nobody counted.
constexpr double kVertices = 4;

report::TestedKinds kinds_of(const report::Scene& scene) {
  const auto share = [&](const char* kind) {
    const auto found = scene.counts.find(kind);
    return found == scene.counts.end()
               ? 0
               : static_cast<double>(found->second) / static_cast<double>(scene.objects);
  };
  return {share("triangle"), share("polygon"), share("sphere"), share("cone"), kVertices * share("polygon")};
}

}  // namespace

report::TestedKinds tested_kinds(const report::Scene& scene, const Entry& entry) {
  return entry.measurement->tested_kinds.value_or(kinds_of(scene));
}

bool incoherent(const Group& group) {
  const std::string distribution = group.rays ? group.rays->distribution : "";
  return distribution == "diffuse" || distribution == "chords" || distribution == "points";
}

}  // namespace rayshoot::analysis
