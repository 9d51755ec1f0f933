#include "harness/measure/counting.h"

#include <algorithm>
#include <random>

namespace rayshoot {

namespace {

/// Rays whose strict work is counted first, to learn how many more are affordable.
constexpr std::size_t kProbeRays = 256;

/// M: the mean number of distinct candidates over the number of objects, equation (21), with the 95 % interval of the mean.
struct Mean {
  double m = 0;
  std::array<double, 2> ci95{};
};

Mean mean_of(double rays, double distinct, double variance_of_mean, std::uint32_t objects) {
  const double mean = distinct / rays, half_width = 1.959964 * std::sqrt(std::max(0.0, variance_of_mean));
  return {mean / objects, {std::max(0.0, mean - half_width) / objects, (mean + half_width) / objects}};
}

/// Two neighbours in the set are a stratum, so the variance is that within pairs (Cochran 1977, §5A.12): rays of
/// neighbouring pixels are alike, and rays that have nothing to do with their neighbours lose nothing by it.
Mean efficiency(const CountedWork& counted, std::uint32_t objects) {
  if (counted.total.rays == 0 || objects == 0) return {};
  const auto rays = static_cast<double>(counted.total.rays);
  return mean_of(rays, static_cast<double>(counted.total.distinct_objects),
                 counted.distinct_differences / (rays * rays), objects);
}

/// Leaf-count variability; absent where there are no cells.
std::optional<double> cells_deviation(const CountedWork& counted) {
  if (counted.total.cells == 0) return std::nullopt;
  const auto rays = static_cast<double>(counted.total.rays);
  const double mean = static_cast<double>(counted.total.cells) / rays;
  return std::sqrt(std::max(0.0, counted.cell_squares / rays - mean * mean));
}

/// Rays in runs of neighbours, which are alike: the runs are what is independent.
struct SampledRuns {
  CountedWork counted;
  double runs = 0;
  /// Sums over runs: of the square of its distinct candidates, of these times its rays, of the square of its rays.
  double squares = 0, products = 0, squared_rays = 0;

  void add(const CountedWork& run) {
    const auto distinct = static_cast<double>(run.total.distinct_objects),
               rays = static_cast<double>(run.total.rays);
    counted += run;
    ++runs, squares += distinct * distinct, products += distinct * rays, squared_rays += rays * rays;
  }
};

/// The estimate of a ratio from clusters (Cochran 1977, §6.3).
Mean efficiency(const SampledRuns& sample, std::uint32_t objects) {
  if (sample.counted.total.rays == 0 || objects == 0) return {};
  const auto rays = static_cast<double>(sample.counted.total.rays),
             distinct = static_cast<double>(sample.counted.total.distinct_objects);
  const double mean = distinct / rays;
  const double residuals = sample.squares - 2 * mean * sample.products + mean * mean * sample.squared_rays;
  return mean_of(rays, distinct, sample.runs / std::max(1.0, sample.runs - 1) * residuals / (rays * rays),
                 objects);
}

template <class Real>
CountedWork count_rays(const Engine<Real>& engine, Query query, std::span<const Ray<Real>> rays,
                       ThreadScratch<Real>& scratch, int threads) {
  std::vector<Hit<Real>> hits(rays.size());
  return count_work(engine, query, rays, std::span(hits), scratch, threads);
}

/// Count the rays in small runs of neighbours, in random order, until `enough` says so. They are not copied, so that
/// a technique which replays hits can tell which rays they are.
template <class Real, class Enough>
SampledRuns count_sample(const Engine<Real>& engine, std::span<const Ray<Real>> rays, std::uint64_t seed,
                         ThreadScratch<Real>& scratch, const Enough& enough) {
  constexpr std::size_t kNeighbours = 16;
  std::vector<std::size_t> starts;
  for (std::size_t first = 0; first < rays.size(); first += kNeighbours) starts.push_back(first);
  std::mt19937_64 generator(seed);
  std::shuffle(starts.begin(), starts.end(), generator);
  SampledRuns sample;
  for (const std::size_t first : starts) {
    if (enough(sample.counted)) break;
    const std::size_t length = std::min(kNeighbours, rays.size() - first);
    sample.add(count_rays(engine, Query::strict, rays.subspan(first, length), scratch, 1));
  }
  return sample;
}

/// Work of the strict optimizer and M, on all rays where that takes no more than `strict_tests` ray-object tests, else on
/// a random sample that does.
template <class Real>
std::pair<Work, Mean> count_strict(const Engine<Real>& engine, const Batch<Real>& batch,
                                   std::uint32_t objects, double strict_tests, std::uint64_t seed,
                                   ThreadScratch<Real>& scratch, int threads) {
  const Work probe = count_sample<Real>(engine, batch.all(), seed, scratch, [](const CountedWork& counted) {
                       return counted.total.rays >= kProbeRays;
                     }).counted.total;
  const double tests_per_ray =
      static_cast<double>(probe.object_tests) / std::max(1.0, static_cast<double>(probe.rays));
  if (tests_per_ray * static_cast<double>(batch.rays.size()) <= strict_tests) {
    const CountedWork all = count_rays(engine, Query::strict, batch.all(), scratch, threads);
    return {all.total, efficiency(all, objects)};
  }
  const SampledRuns sample =
      count_sample<Real>(engine, batch.all(), seed, scratch, [&](const CountedWork& counted) {
        return counted.total.rays >= kProbeRays &&
               static_cast<double>(counted.total.object_tests) >= strict_tests;
      });
  return {sample.counted.total, efficiency(sample, objects)};
}

}  // namespace

template <class Real>
double relative_m_error(const Engine<Real>& engine, const Batch<Real>& batch, std::uint32_t objects,
                        int threads) {
  ThreadScratch<Real> scratch(engine);
  CountedWork counted = count_rays(engine, Query::closest, batch.closest(), scratch, threads);
  counted += count_rays(engine, Query::any, batch.any(), scratch, threads);
  const Mean m = efficiency(counted, objects);
  return m.m > 0 ? (m.ci95[1] - m.m) / m.m : 0;
}

template <class Real>
Counts count(const Engine<Real>& engine, const Batch<Real>& batch, std::uint32_t objects, double strict_tests,
             std::uint64_t seed, int threads) {
  ThreadScratch<Real> scratch(engine);
  CountedWork counted = count_rays(engine, Query::closest, batch.closest(), scratch, threads);
  counted += count_rays(engine, Query::any, batch.any(), scratch, threads);
  const auto [strict, m_strict] = count_strict(engine, batch, objects, strict_tests, seed, scratch, threads);
  const Mean m = efficiency(counted, objects);
  return {counted.total, strict, {m.m, m.ci95, m_strict.m, m_strict.ci95}, cells_deviation(counted)};
}

template Counts count<float>(const Engine<float>&, const Batch<float>&, std::uint32_t, double, std::uint64_t,
                             int);
template Counts count<double>(const Engine<double>&, const Batch<double>&, std::uint32_t, double,
                              std::uint64_t, int);
template double relative_m_error(const Engine<float>&, const Batch<float>&, std::uint32_t, int);
template double relative_m_error(const Engine<double>&, const Batch<double>&, std::uint32_t, int);

}  // namespace rayshoot
