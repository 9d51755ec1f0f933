#pragma once

#include "analysis/cost_models/cost_model.h"

namespace rayshoot::analysis {

/// The kinds of the objects that a cell tests; those of the scene where the report does not tell.
report::TestedKinds tested_kinds(const report::Scene& scene, const Entry& entry);

/// Whether neighbours of a ray set have nothing to do with each other.
bool incoherent(const Group& group);

}  // namespace rayshoot::analysis
