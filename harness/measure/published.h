#pragma once

#include "harness/plan/published.h"
#include "harness/report/report.h"
#include "scenes/rays/ray_set.h"

namespace rayshoot {

/// One of `figure_names` as it was measured; nothing where it was not. "Per ray" divides by all rays that the publisher
/// counts: ours, and refracted rays that there were not for total internal reflection.
std::optional<double> figure_of(const std::string& figure, const report::Measurement& measurement,
                                const RaySet& set);

/// A row's figures and ours.
std::vector<report::PublishedFigure> compared(const PublishedRow& row, const report::Measurement& measurement,
                                              const RaySet& set);

/// A claim, and what our times say to it where both techniques were timed.
report::Claim judged(const PublishedClaim& claim, const report::Measurement* first,
                     const report::Measurement* second, const std::string& scalar);

}  // namespace rayshoot
