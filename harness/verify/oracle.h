#pragma once

#include <string>
#include <vector>

#include "harness/report/report.h"
#include "harness/verify/answers.h"
#include "harness/verify/reference.h"

namespace rayshoot {

/// A technique's answers, to be judged.
template <class Real>
struct Statement {
  const TechniqueInfo* technique;
  const Answers<Real>* answers;
};

/// Knows the right answers to a batch. Where exhaustive search of all rays is within `check_tests` ray-object
/// tests, they are its answers. Otherwise they come from a reference technique that equals exhaustive search
/// on a random sample of that much work; where a technique contradicts the reference, exhaustive search of
/// that ray decides who is right.
template <class Real>
class Oracle {
 public:
  Oracle(References<Real>& references, const Batch<Real>& batch, double check_tests, std::uint64_t seed,
         int threads);

  /// The nearest hits of all rays, also of those that ask for any.
  RecordedHits<Real> recorded() const { return {batch_.rays, hits_}; }

  /// One verdict a statement. Answers must equal the right ones, distances included; an engine with an object
  /// test of its own is graded: its distances may differ by rounding.
  std::vector<report::Verdict> judge(const std::vector<Statement<Real>>& statements);

 private:
  void search_exhaustively(const std::vector<std::uint32_t>& rays);
  bool agree(const Statement<Real>& statement, std::uint32_t ray) const;
  bool settle(const Statement<Real>& statement, std::uint32_t ray);
  report::Verdict judge(const Statement<Real>& statement);

  const Batch<Real>& batch_;
  int threads_;
  const Engine<Real>& exhaustive_;
  /// Technique that gave the answers that are not checked; "exhaustive" where all are.
  std::string reference_;
  std::vector<Hit<Real>> hits_;
  /// Rays whose hits are those of exhaustive search.
  std::vector<std::uint8_t> checked_;
  std::uint64_t reference_errors_ = 0;
};

extern template class Oracle<float>;
extern template class Oracle<double>;

}  // namespace rayshoot
