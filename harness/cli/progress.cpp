#include "harness/cli/progress.h"

#include <fmt/format.h>
#include <unistd.h>

#include <cstdio>

namespace rayshoot::cli {

namespace {

constexpr std::size_t kWidth = 100;
constexpr const char* kClearLine = "\r\x1b[K";

}  // namespace

Progress::Progress(std::size_t cells) : terminal_(isatty(STDERR_FILENO) != 0), cells_(cells) {}

Progress::~Progress() {
  if (terminal_) fmt::print(stderr, "{}", kClearLine);
}

/// "12 of 96 cells, 1.3 cells/s, 1:05 left".
std::string Progress::standing() const {
  const std::string count = fmt::format("{} of {} cells", finished_, cells_);
  const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
  if (finished_ == 0 || seconds <= 0) return count;
  const double rate = static_cast<double>(finished_) / seconds;
  const auto left = static_cast<long long>(static_cast<double>(cells_ - finished_) / rate);
  return fmt::format("{}, {:.2g} cells/s, {}:{:02} left", count, rate, left / 60, left % 60);
}

void Progress::doing(const std::string& step) {
  if (!terminal_) return;
  const std::string line = fmt::format("{}  {}", standing(), step);
  fmt::print(stderr, "{}{}", kClearLine, line.substr(0, kWidth));
  std::fflush(stderr);
}

void Progress::finished(std::size_t cells) {
  finished_ += cells;
  if (!terminal_ && cells > 0) fmt::print(stderr, "{}\n", standing());
}

}  // namespace rayshoot::cli
