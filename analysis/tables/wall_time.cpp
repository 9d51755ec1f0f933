#include "analysis/tables/wall_time.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <vector>

#include "analysis/tables/page.h"

namespace rayshoot::analysis {

namespace {

/// Phases with less are not worth a word.
constexpr double kSmallShare = 0.005;

using Share = std::pair<std::string, double>;

std::string in_words(std::vector<Share> shares) {
  std::stable_sort(shares.begin(), shares.end(),
                   [](const Share& a, const Share& b) { return a.second > b.second; });
  std::vector<std::string> words;
  for (const auto& [phase, share] : shares)
    if (share >= kSmallShare) words.push_back(fmt::format("{} {:.0f} %", phase, 100 * share));
  return fmt::format("{}", fmt::join(words, ", "));
}

}  // namespace

std::string wall_time(const report::Run& run) {
  double seconds = 0, timed_share = 0;
  for (const auto& [phase, of_phase] : run.phase_seconds) seconds += of_phase;
  if (seconds <= 0) return {};
  std::vector<Share> timed, rest;
  for (const auto& [phase, of_phase] : run.phase_seconds) {
    const bool is_timed = phase == "build" || phase == "trace";
    (is_timed ? timed : rest).emplace_back(phase, of_phase / seconds);
    if (is_timed) timed_share += of_phase / seconds;
  }
  std::string text = fmt::format("timed work {:.0f} % of {} s", 100 * timed_share, significant(seconds));
  if (const std::string words = in_words(timed); !words.empty()) text += fmt::format(" ({})", words);
  if (const std::string words = in_words(rest); !words.empty()) text += fmt::format("; {}", words);
  return text;
}

}  // namespace rayshoot::analysis
