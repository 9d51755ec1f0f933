#include "harness/torture/isolation.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/mman.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <cstdio>
#include <thread>

#include "harness/torture/grader.h"

namespace rayshoot {

namespace {

using Clock = std::chrono::steady_clock;

/// The patience with a process that builds.
constexpr std::chrono::seconds kBuildingPatience{300};
/// Rays that end a process before a cell is given up.
constexpr std::uint64_t kMostCrashes = 20;

void say(Tally& tally, const std::string& message) {
  const std::size_t length = std::min(message.size(), tally.message.size() - 1);
  std::copy_n(message.begin(), length, tally.message.begin());
  tally.message[length] = 0;
}

/// Silence what a library prints when it aborts.
void close_stderr() {
  const int nowhere = open("/dev/null", O_WRONLY);
  if (nowhere >= 0) dup2(nowhere, STDERR_FILENO);
}

}  // namespace

/// A cell whose process runs, or that waits for its next process.
struct IsolatedCells::Running {
  const TortureCell& cell;
  Tally* tally;
  pid_t process = -1;
  /// Rays up to this number are traced one at a time, to find the one that ended a process.
  std::uint64_t one_by_one_until = 0;
  std::uint64_t seen_pulse = 0;
  Clock::time_point seen_at;
  bool killed = false;

  explicit Running(const TortureCell& of) : cell(of) {
    void* const memory =
        mmap(nullptr, sizeof(Tally), PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
    if (memory == MAP_FAILED) throw std::bad_alloc();
    tally = new (memory) Tally;
    launch();
  }
  ~Running() {
    if (process > 0) kill(process, SIGKILL), waitpid(process, nullptr, 0);
    munmap(tally, sizeof(Tally));
  }
  Running(const Running&) = delete;

  void launch() {
    tally->built = false, killed = false;
    seen_pulse = tally->pulse, seen_at = Clock::now();
    process = fork();
    if (process < 0) throw std::bad_alloc();
    if (process == 0) work();
  }

  /// What the process does, and never returns from.
  [[noreturn]] void work() {
    std::signal(SIGINT, SIG_IGN);
    close_stderr();
    try {
      if (tally->rays < one_by_one_until) grade(cell, *tally, one_by_one_until, 1);
      grade(cell, *tally, cell.rays, kTorturedAtOnce);
    } catch (const std::exception& error) {
      say(*tally, error.what());
    }
    _exit(0);
  }

  void kill_if_stuck(std::chrono::milliseconds patience) {
    if (tally->pulse != seen_pulse) seen_pulse = tally->pulse, seen_at = Clock::now();
    if (killed || Clock::now() - seen_at < (tally->built ? patience : kBuildingPatience)) return;
    kill(process, SIGKILL);
    killed = true;
  }

  /// The process has ended; whether the cell is done. Otherwise go on behind the ray that ended it.
  bool done(int status) {
    process = -1;
    if (WIFEXITED(status) && WEXITSTATUS(status) == 0) return true;
    const AnswerClass answer = killed ? AnswerClass::over_steps : AnswerClass::crash;
    if (!tally->built) return ++tally->grades[answer], say(*tally, "ended while it was built"), true;
    if (tally->rays >= one_by_one_until) {
      one_by_one_until = std::min(cell.rays, tally->rays + kTorturedAtOnce);
    } else {
      ++tally->grades[answer], ++tally->rays;
      if (tally->grades[AnswerClass::crash] + tally->grades[AnswerClass::over_steps] >= kMostCrashes)
        return say(*tally, fmt::format("given up after {} crashes", kMostCrashes)), true;
      if (tally->rays == cell.rays) return true;
    }
    launch();
    return false;
  }
};

IsolatedCells::IsolatedCells(int processes, Finished finished, std::chrono::milliseconds patience)
    : processes_(static_cast<std::size_t>(processes)), patience_(patience), finished_(std::move(finished)) {}

IsolatedCells::~IsolatedCells() = default;

void IsolatedCells::start(const TortureCell& cell) {
  while (running_.size() >= processes_) wait_for_one();
  std::fflush(nullptr);
  running_.push_back(std::make_unique<Running>(cell));
}

void IsolatedCells::finish() {
  while (!running_.empty()) wait_for_one();
}

void IsolatedCells::wait_for_one() {
  for (std::size_t i = 0; i < running_.size(); ++i) {
    Running& running = *running_[i];
    int status = 0;
    if (waitpid(running.process, &status, WNOHANG) == 0) {
      running.kill_if_stuck(patience_);
    } else if (running.done(status)) {
      finished_(running.cell, *running.tally);
      running_.erase(running_.begin() + static_cast<std::ptrdiff_t>(i));
      return;
    }
  }
  std::this_thread::sleep_for(std::chrono::milliseconds(2));
}

}  // namespace rayshoot
