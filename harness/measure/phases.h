#pragma once

#include <array>
#include <chrono>
#include <map>
#include <string>
#include <utility>

namespace rayshoot {

/// What a run does: generates and compiles scenes, hashes scenes and rays, makes rays, builds, verifies answers, counts work,
/// grades exactly, traces. Builds and traces are the timed work.
enum class Phase { generate, hash, rays, build, verify, count, grade, trace, other };
inline constexpr std::array kPhaseNames = {"generate", "hash",  "rays",  "build", "verify",
                                           "count",    "grade", "trace", "other"};

/// What the wall time of a run is spent on. Phases nest: while an inner one lasts, the outer one stands still, so
/// that their times add up to the whole.
class Phases {
 public:
  /// A phase from here to the end of the block.
  class Scope {
   public:
    Scope(Phases& phases, Phase phase) : phases_(phases), outer_(phases.enter(phase)) {}
    ~Scope() { phases_.enter(outer_); }
    Scope(const Scope&) = delete;
    Scope& operator=(const Scope&) = delete;

   private:
    Phases& phases_;
    Phase outer_;
  };
  [[nodiscard]] Scope scope(Phase phase) { return Scope(*this, phase); }

  /// The seconds of every phase that was so far, by name.
  std::map<std::string, double> seconds() {
    enter(current_);
    std::map<std::string, double> named;
    for (const auto& [phase, seconds] : seconds_)
      named[kPhaseNames[static_cast<std::size_t>(phase)]] = seconds;
    return named;
  }

 private:
  using Clock = std::chrono::steady_clock;

  /// Book the time since the last change of phase, and return which one that was.
  Phase enter(Phase phase) {
    const Clock::time_point now = Clock::now();
    seconds_[current_] += std::chrono::duration<double>(now - since_).count();
    since_ = now;
    return std::exchange(current_, phase);
  }

  std::map<Phase, double> seconds_;
  Phase current_ = Phase::other;
  Clock::time_point since_ = Clock::now();
};

}  // namespace rayshoot
