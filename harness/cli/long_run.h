#pragma once

#include <string>

/// What the commands share that run for long and write a report.
namespace rayshoot::cli {

inline constexpr int kCheckFailed = 1;
inline constexpr int kInterrupted = 130;

/// From now on the first interrupt asks the run to stop after the step in hand; a second one ends the program at once.
void stop_on_interrupt();
bool interrupted();

/// From now on memory that was freed stays with the process. Otherwise it depends on what lies above it whether it goes
/// back, and then the next build pays for its pages again: medians of builds of one program were seen to differ by 1.8 times
/// from run to run. Does nothing where the allocator is not that of the GNU library.
void keep_freed_memory();

/// Where a report is to be written: `given`, or, where that is empty, results/local of the project the program was
/// built in or of the current folder. Throws InputError unless a file can be written there.
std::string report_path(const std::string& given, const std::string& run_id);

}  // namespace rayshoot::cli
