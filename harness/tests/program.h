#pragma once

#include <chrono>
#include <csignal>
#include <filesystem>
#include <string>
#include <vector>

namespace rayshoot::test {

/// A folder that is gone, with all in it, at the end of its scope.
class TemporaryFolder {
 public:
  TemporaryFolder();
  ~TemporaryFolder();
  TemporaryFolder(const TemporaryFolder&) = delete;
  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

/// What a run of the program left behind.
struct Outcome {
  int status = 0;
  std::string output;
  std::string errors;
};

/// Run the built program with `arguments`, in `directory`, and wait. Output and errors are not terminals.
Outcome run_program(const std::vector<std::string>& arguments, const std::filesystem::path& directory = ".");

/// The same, with a signal, or with an interrupt, as Ctrl-C sends it, as soon as the program has written `sign` to its
/// errors.
Outcome interrupt_program(const std::vector<std::string>& arguments, const std::string& sign,
                          const std::filesystem::path& directory, int signal = SIGINT);

/// The same, killed after so long, without a chance to clean up; its status is then -1.
Outcome kill_program(const std::vector<std::string>& arguments, std::chrono::milliseconds after,
                     const std::filesystem::path& directory);

}  // namespace rayshoot::test
