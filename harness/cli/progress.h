#pragma once

#include <chrono>
#include <string>

#include "harness/measure/run.h"

namespace rayshoot::cli {

/// Tells on stderr how a run gets on: on a terminal one line that is kept up to date, with rate and time
/// left; elsewhere a plain line whenever cells are finished.
class Progress final : public RunObserver {
 public:
  explicit Progress(std::size_t cells);
  /// Clears the line.
  ~Progress() override;
  Progress(const Progress&) = delete;

  void doing(const std::string& step) override;
  void finished(std::size_t cells) override;

 private:
  std::string standing() const;

  bool terminal_;
  std::size_t cells_, finished_ = 0;
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

}  // namespace rayshoot::cli
