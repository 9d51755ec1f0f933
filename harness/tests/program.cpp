#include "program.h"

#include <fmt/format.h>
#include <sys/wait.h>

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

TemporaryFolder::TemporaryFolder() {
  std::string name = (std::filesystem::temp_directory_path() / "rayshoot_test_XXXXXX").string();
  if (!mkdtemp(name.data())) throw std::runtime_error("no temporary folder");
  path_ = name;
}

TemporaryFolder::~TemporaryFolder() {
  std::error_code ignored;
  std::filesystem::remove_all(path_, ignored);
}

Outcome run_program(const std::vector<std::string>& arguments, const std::filesystem::path& directory) {
  const TemporaryFolder streams;
  const std::string output = streams.path() / "output", errors = streams.path() / "errors";
  std::string command = fmt::format("cd {} && {}", quoted(directory), quoted(RAYSHOOT_PROGRAM));
  for (const std::string& argument : arguments) command.append(" ").append(quoted(argument));
  const int status = std::system(fmt::format("{} >{} 2>{}", command, quoted(output), quoted(errors)).c_str());
  return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, contents(output), contents(errors)};
}

}  // namespace rayshoot::test
