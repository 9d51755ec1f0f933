#include "program.h"

#include <fmt/format.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <thread>

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

/// Become the program; called in a process of its own.
[[noreturn]] void become_program(const std::vector<std::string>& arguments,
                                 const std::filesystem::path& directory, const std::string& output,
                                 const std::string& errors) {
  std::vector<std::string> words{RAYSHOOT_PROGRAM};
  words.insert(words.end(), arguments.begin(), arguments.end());
  std::vector<char*> pointers;
  for (std::string& word : words) pointers.push_back(word.data());
  pointers.push_back(nullptr);
  if (std::freopen(output.c_str(), "w", stdout) && std::freopen(errors.c_str(), "w", stderr) &&
      chdir(directory.c_str()) == 0)
    execv(RAYSHOOT_PROGRAM, pointers.data());
  _exit(127);
}

bool has_ended(pid_t process) {
  siginfo_t ended{};
  return waitid(P_PID, static_cast<id_t>(process), &ended, WEXITED | WNOHANG | WNOWAIT) != 0 ||
         ended.si_pid != 0;
}

/// Wait until something is so, or for the end of a process; true when that has not ended.
template <class Condition>
bool wait_until(const Condition& condition, pid_t process) {
  do {
    if (condition()) return true;
    std::this_thread::sleep_for(std::chrono::milliseconds(2));
  } while (!has_ended(process));
  return false;
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

namespace {

/// Run the program, and send it a signal when `wait`, which is told its errors and its process, says so.
template <class Wait>
Outcome signal_program(const std::vector<std::string>& arguments, const std::filesystem::path& directory,
                       int signal, const Wait& wait) {
  const TemporaryFolder streams;
  const std::string output = streams.path() / "output", errors = streams.path() / "errors";
  const pid_t process = fork();
  if (process < 0) throw std::runtime_error("no process");
  if (process == 0) become_program(arguments, directory, output, errors);
  if (wait(errors, process)) kill(process, signal);
  int status = 0;
  waitpid(process, &status, 0);
  return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, contents(output), contents(errors)};
}

}  // namespace

Outcome interrupt_program(const std::vector<std::string>& arguments, const std::string& sign,
                          const std::filesystem::path& directory, int signal) {
  return signal_program(arguments, directory, signal, [&](const std::string& errors, pid_t process) {
    return wait_until([&] { return contents(errors).find(sign) != std::string::npos; }, process);
  });
}

Outcome kill_program(const std::vector<std::string>& arguments, std::chrono::milliseconds after,
                     const std::filesystem::path& directory) {
  const auto moment = std::chrono::steady_clock::now() + after;
  return signal_program(arguments, directory, SIGKILL, [&](const std::string&, pid_t process) {
    return wait_until([&] { return std::chrono::steady_clock::now() >= moment; }, process);
  });
}

}  // namespace rayshoot::test
