#include "harness/verify/equation3.h"

namespace rayshoot {

namespace {

constexpr double kNormal95 = 1.959963984540054;  // two-sided 95 % point of the normal distribution

Equation3Check check(const std::string& quantity, double predicted, double sum, double squares,
                     std::uint64_t rays) {
  const double count = static_cast<double>(rays);
  const double mean = sum / count;
  const double variance = std::max(0.0, squares / count - mean * mean) * count / (count - 1);
  const double half_width = kNormal95 * std::sqrt(variance / count);
  return {quantity, predicted, mean, mean - half_width, mean + half_width, rays};
}

}  // namespace

template <class Real>
std::vector<Equation3Check> check_equation_3(const Engine<Real>& engine, std::span<const Ray<Real>> chords,
                                             int threads) {
  const auto prediction = engine.predicted();
  if (!prediction || !engine.countable())
    throw InputError("equation (3) does not apply: no hierarchy of volumes");

  // Keep the lines that hit the root volume, to which equation (2) is conditional.
  std::vector<Ray<Real>> hitting;
  for (const Ray<Real>& ray : chords) {
    const Interval<Real> inside = Crossings<Real>(ray).inside(prediction->root);
    if (!prediction->root.empty() && inside.enter <= inside.exit) hitting.push_back(ray);
  }
  if (hitting.size() < 2) return {};

  // Count the tests of the strict optimizer on them: equation (3) neglects occlusion.
  std::vector<Hit<Real>> hits(hitting.size());
  ThreadScratch<Real> scratch(engine);
  const CountedWork work = count_work<Real>(engine, Query::strict, hitting, hits, scratch, threads);
  return {check("object_tests", prediction->object_tests, static_cast<double>(work.total.object_tests),
                work.object_test_squares, hitting.size()),
          check("volume_tests", prediction->volume_tests, static_cast<double>(work.total.volume_tests),
                work.volume_test_squares, hitting.size())};
}

template std::vector<Equation3Check> check_equation_3(const Engine<float>&, std::span<const Ray<float>>, int);
template std::vector<Equation3Check> check_equation_3(const Engine<double>&, std::span<const Ray<double>>,
                                                      int);

}  // namespace rayshoot
