#include "program.h"

#include <fmt/format.h>
#include <sys/wait.h>
#include <unistd.h>

#include <atomic>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>

namespace rayshoot::test {

namespace {

std::string quoted(const std::string& word) {
  std::string result;
  for (const char c : word) c == '\'' ? result.append("'\\''") : result.append(1, c);
  return fmt::format("'{}'", result);
}

std::string contents(const std::filesystem::path& path) {
  std::ostringstream text;
  text << std::ifstream(path).rdbuf();
  return text.str();
}

}  // namespace

Outcome run_program(const std::vector<std::string>& arguments, const std::string& directory) {
  static std::atomic<int> runs = 0;
  const std::string stem = fmt::format("{}/rayshoot_test_{}_{}",
                                       std::filesystem::temp_directory_path().string(), getpid(), runs++);
  const std::string output = stem + ".out", errors = stem + ".err";
  std::string command = fmt::format("cd {} && {}", quoted(directory), quoted(RAYSHOOT_PROGRAM));
  for (const std::string& argument : arguments) command.append(" ").append(quoted(argument));
  const int status = std::system(fmt::format("{} >{} 2>{}", command, quoted(output), quoted(errors)).c_str());
  const Outcome outcome{WIFEXITED(status) ? WEXITSTATUS(status) : -1, contents(output), contents(errors)};
  std::filesystem::remove(output), std::filesystem::remove(errors);
  return outcome;
}

}  // namespace rayshoot::test
