#pragma once

#include <chrono>

#include "harness/torture/cell.h"
#include "harness/torture/tally.h"

namespace rayshoot {

/// Runs cells, each in a process of its own, several at once. The process that calls must have no other threads.
class IsolatedCells {
 public:
  /// Called with a cell and its tally when it is done.
  using Finished = std::function<void(const TortureCell&, const Tally&)>;

  /// A process that gets no further for `patience`, once it has built, has lost its way.
  IsolatedCells(int processes, Finished finished,
                std::chrono::milliseconds patience = std::chrono::seconds(20));
  ~IsolatedCells();
  IsolatedCells(const IsolatedCells&) = delete;

  /// Start a cell, waiting for another to finish while too many run. The cell must outlive its process.
  void start(const TortureCell& cell);
  /// Wait until all have finished.
  void finish();

 private:
  struct Running;
  void wait_for_one();

  std::size_t processes_;
  std::chrono::milliseconds patience_;
  Finished finished_;
  std::vector<std::unique_ptr<Running>> running_;
};

}  // namespace rayshoot
