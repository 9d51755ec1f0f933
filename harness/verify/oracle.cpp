#include "harness/verify/oracle.h"

#include <algorithm>
#include <numeric>
#include <random>

namespace rayshoot {

namespace {

/// Contradictions between a technique and the reference that are decided ray by ray; further ones count as
/// wrong.
constexpr int kSettledRays = 50;
/// The share of a ray's exhaustive search that is affordable below which none is searched so, unless techniques disagree.
constexpr double kHopeless = 0.5;
/// Relative difference in distance up to which an object test of another design is right.
constexpr double kGradedTolerance = 1e-3;

std::vector<std::uint32_t> random_sample(std::size_t population, std::size_t size, std::uint64_t seed) {
  std::vector<std::uint32_t> all(population), sample;
  std::iota(all.begin(), all.end(), 0u);
  std::mt19937_64 generator(seed);
  std::sample(all.begin(), all.end(), std::back_inserter(sample), size, generator);
  return sample;
}

}  // namespace

template <class Real>
Oracle<Real>::Oracle(References<Real>& references, const Batch<Real>& batch, double check_tests,
                     std::uint64_t seed, int threads)
    : batch_(batch),
      threads_(threads),
      exhaustive_(references.exhaustive()),
      reference_(kExhaustiveTechnique),
      hits_(batch.rays.size()),
      checked_(batch.rays.size()) {
  const double affordable = check_tests / std::max(1.0, static_cast<double>(references.geometry().numbers()));
  const std::size_t rays = batch.rays.size();
  // A ray at least, but for scenes of so many placed objects that one alone takes minutes.
  const double least = affordable < kHopeless ? 0 : 1;
  const auto sample_size =
      static_cast<std::size_t>(std::clamp(affordable, least, std::max(1.0, static_cast<double>(rays))));
  if (sample_size < rays) {
    reference_ = kReferenceTechnique;
    const Engine<Real>& engine = references.reference();
    ThreadScratch<Real> scratch(engine);
    trace_closest(engine, batch.all(), std::span(hits_), scratch, threads);
  }
  search_exhaustively(random_sample(rays, sample_size, seed));
}

/// Replace the hits of some rays by those of exhaustive search and note where the reference was wrong.
template <class Real>
void Oracle<Real>::search_exhaustively(const std::vector<std::uint32_t>& rays) {
  std::vector<Hit<Real>> found(rays.size());
  ThreadScratch<Real> scratch(exhaustive_);
  tbb::task_arena(threads_).execute([&] {
    tbb::parallel_for(std::size_t{0}, rays.size(), [&](std::size_t i) {
      exhaustive_.closest(batch_.all().subspan(rays[i], 1), std::span(found).subspan(i, 1), scratch.local());
    });
  });
  for (std::size_t i = 0; i < rays.size(); ++i) {
    if (reference_ != kExhaustiveTechnique && hits_[rays[i]] != found[i]) ++reference_errors_;
    hits_[rays[i]] = found[i];
    checked_[rays[i]] = true;
  }
}

/// Whether a technique's answer to a ray is the one that is known.
template <class Real>
bool Oracle<Real>::agree(const Statement<Real>& statement, std::uint32_t ray) const {
  const Hit<Real>& right = hits_[ray];
  if (ray >= batch_.closest_rays)
    return (statement.answers->blocked[ray - batch_.closest_rays] != 0) == (right.object != kNoObject);
  const Hit<Real>& answer = statement.answers->hits[ray];
  if (!statement.technique->own_object_test) return answer == right;
  if (answer.object == kNoObject || right.object == kNoObject) return answer.object == right.object;
  return std::abs(static_cast<double>(answer.t) - static_cast<double>(right.t)) <=
         kGradedTolerance * static_cast<double>(right.t);
}

/// Let exhaustive search decide a contradiction; returns whether the technique was right after all.
template <class Real>
bool Oracle<Real>::settle(const Statement<Real>& statement, std::uint32_t ray) {
  search_exhaustively({ray});
  return agree(statement, ray);
}

template <class Real>
report::Verdict Oracle<Real>::judge(const Statement<Real>& statement) {
  const bool graded = statement.technique->own_object_test;
  const bool is_reference = statement.technique->id == reference_;
  // A reference that was caught in an error vouches for nothing: only what exhaustive search says counts
  // then.
  const bool only_checked = reference_errors_ > 0 || is_reference;
  report::Verdict verdict{.reference = only_checked ? kExhaustiveTechnique : reference_};
  int unsettled = graded ? 0 : kSettledRays;
  for (std::uint32_t ray = 0; ray < hits_.size(); ++ray) {
    if (only_checked && !checked_[ray]) continue;
    ++verdict.checked_rays;
    if (agree(statement, ray)) continue;
    if (!checked_[ray] && unsettled-- > 0 && settle(statement, ray)) continue;
    ++verdict.wrong_rays;
  }
  verdict.status = graded                    ? report::Status::graded
                   : verdict.wrong_rays == 0 ? report::Status::ok
                                             : report::Status::wrong;
  return verdict;
}

template <class Real>
std::vector<report::Verdict> Oracle<Real>::judge(const std::vector<Statement<Real>>& statements) {
  std::vector<report::Verdict> verdicts(statements.size());
  const auto judge_all = [&] {
    std::transform(statements.begin(), statements.end(), verdicts.begin(),
                   [&](const auto& s) { return judge(s); });
  };
  const std::uint64_t known_errors = reference_errors_;
  judge_all();
  // A contradiction may have exposed the reference, on whose word others were judged before.
  if (reference_errors_ != known_errors) judge_all();
  return verdicts;
}

template class Oracle<float>;
template class Oracle<double>;

}  // namespace rayshoot
