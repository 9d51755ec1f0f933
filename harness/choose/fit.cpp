#include "harness/choose/fit.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "analysis/statistics/nnls.h"
#include "analysis/statistics/sample.h"
#include "harness/choose/terms.h"
#include "scenes/core/spec.h"

namespace rayshoot {

namespace {

/// A candidate with its time; `best` is that of the fastest in the same cell.
struct Observation {
  const report::Candidate* candidate;
  double ns_per_ray;
  double best = 0;
};

/// Nanoseconds a ray that a candidate took; nothing where it was not timed.
std::optional<double> measured_ns(const report::Report& report, const report::Choice& choice,
                                  const report::Candidate& candidate) {
  const auto rays = std::find_if(report.ray_sets.begin(), report.ray_sets.end(),
                                 [&](const report::RaySet& set) { return set.id == choice.rays; });
  for (const report::Measurement& m : report.measurements) {
    if (m.scene != choice.scene || m.rays != choice.rays || m.scalar != choice.scalar ||
        m.intersector != choice.intersector || m.technique != candidate.technique ||
        m.config != candidate.config)
      continue;
    const auto median = analysis::median(m.trace_ns);
    if (median && rays != report.ray_sets.end() && rays->rays > 0)
      return median->value / static_cast<double>(rays->rays);
  }
  return std::nullopt;
}

/// All that was timed, cell after cell.
std::vector<Observation> observations_of(std::span<const report::Report> reports, Constants& constants) {
  std::vector<Observation> all;
  std::set<std::string> scenes;
  for (const report::Report& report : reports)
    for (const report::Choice& choice : report.choices) {
      const std::size_t first = all.size();
      double best = std::numeric_limits<double>::infinity();
      for (const report::Candidate& candidate : choice.candidates)
        if (const auto ns = measured_ns(report, choice, candidate)) {
          all.push_back({&candidate, *ns});
          best = std::min(best, *ns);
        }
      for (std::size_t i = first; i < all.size(); ++i) all[i].best = best;
      if (all.size() > first) ++constants.cells, scenes.insert(choice.scene);
    }
  constants.scenes.assign(scenes.begin(), scenes.end());
  return all;
}

/// Places of the unknowns in a row: the shared ones, then those of one technique after the other.
class Columns {
 public:
  explicit Columns(const std::vector<Observation>& observations) {
    for (const Observation& observation : observations)
      first_.try_emplace(observation.candidate->technique,
                         kObjectTerms.size() + first_.size() * kTechniqueTerms.size());
  }

  std::vector<double> row(const report::Candidate& candidate, double weight) const {
    std::vector<double> row(kObjectTerms.size() + first_.size() * kTechniqueTerms.size(), 0);
    fill(row, 0, kObjectTerms, candidate.counts, weight);
    fill(row, first_.at(candidate.technique), kTechniqueTerms, candidate.counts, weight);
    return row;
  }

  void unpack(const std::vector<double>& solution, Constants& constants) const {
    constants.object_terms_ns = named(solution, 0, kObjectTerms);
    for (const auto& [technique, first] : first_)
      constants.techniques[technique].terms_ns = named(solution, first, kTechniqueTerms);
  }

 private:
  template <class Names>
  static void fill(std::vector<double>& row, std::size_t first, const Names& names,
                   const std::map<std::string, double>& counts, double weight) {
    for (std::size_t i = 0; i < names.size(); ++i)
      if (const auto count = counts.find(names[i]); count != counts.end())
        row[first + i] = count->second * weight;
  }
  template <class Names>
  static std::map<std::string, double> named(const std::vector<double>& solution, std::size_t first,
                                             const Names& names) {
    std::map<std::string, double> terms;
    for (std::size_t i = 0; i < names.size(); ++i)
      if (solution[first + i] > 0) terms[names[i]] = solution[first + i];
    return terms;
  }

  std::map<std::string, std::size_t> first_;
};

/// How each technique compared with the fastest, and how well it is predicted.
void add_records(const std::vector<Observation>& observations, Constants& constants) {
  struct Record {
    double least = std::numeric_limits<double>::infinity(), logarithms = 0, squares = 0, cells = 0;
  };
  std::map<std::string, Record> records;
  for (const auto& [candidate, ns, best] : observations) {
    Record& record = records[candidate->technique];
    const double predicted =
        constants.predicted_ns(constants.techniques.at(candidate->technique), candidate->counts);
    record.least = std::min(record.least, ns / best);
    record.logarithms += std::log(ns / best);
    record.squares += (predicted / ns - 1) * (predicted / ns - 1);
    ++record.cells;
  }
  for (const auto& [technique, record] : records) {
    TechniqueConstants& known = constants.techniques[technique];
    known.at_least = record.least;
    known.on_average = std::exp(record.logarithms / record.cells);
    known.error = std::sqrt(record.squares / record.cells);
  }
}

}  // namespace

Constants fit_constants(std::span<const report::Report> reports) {
  Constants constants;
  const std::vector<Observation> observations = observations_of(reports, constants);
  if (observations.empty()) throw InputError("no report holds a candidate that was counted and timed");
  constants.machine = reports.front().environment.cpu;
  constants.date = reports.front().run.started_utc.substr(0, 10);
  const Columns columns(observations);
  std::vector<std::vector<double>> rows;
  for (const Observation& observation : observations)
    rows.push_back(columns.row(*observation.candidate, 1 / observation.ns_per_ray));
  const auto fit = analysis::non_negative_least_squares(rows, std::vector<double>(observations.size(), 1.0));
  columns.unpack(fit->coefficients, constants);
  add_records(observations, constants);
  return constants;
}

}  // namespace rayshoot
