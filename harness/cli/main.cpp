#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cstdio>

#include "harness/cli/commands.h"
#include "scenes/core/spec.h"

namespace rayshoot::cli {

namespace {

constexpr int kBadInput = 2;

/// The command that was being read when parsing failed: the deepest one that was named.
const CLI::App& active(const CLI::App& program) {
  const auto named = program.get_subcommands();
  return named.empty() ? program : *named.front();
}

std::vector<std::string> option_names(const CLI::App& command) {
  std::vector<std::string> names;
  for (const CLI::Option* option : command.get_options())
    if (!option->get_lnames().empty()) names.push_back("--" + option->get_lnames().front());
  return names;
}

std::vector<std::string> command_names(const CLI::App& program) {
  std::vector<std::string> names;
  for (const CLI::App* command : program.get_subcommands([](const CLI::App*) { return true; }))
    names.push_back(command->get_name());
  return names;
}

/// One line that says what is wrong with the command line and what would have been right.
std::string explain(const CLI::App& program, const CLI::ParseError& error) {
  const CLI::App& command = active(program);
  const bool no_command = &command == &program;
  const auto extras = program.remaining(true);
  if (extras.empty() && no_command)
    return fmt::format("a command is required; known: {}", fmt::join(command_names(program), ", "));
  if (extras.empty() || !(no_command || dynamic_cast<const CLI::ExtrasError*>(&error))) return error.what();
  const std::string& extra = extras.front();
  if (extra.starts_with("-")) return unknown_name("option", extra, option_names(command));
  if (no_command) return unknown_name("command", extra, command_names(program));
  return fmt::format("'{}' is one argument too many for rayshoot {}", extra, command.get_name());
}

int fail(const std::string& message) {
  fmt::print(stderr, "rayshoot: {}\n", message);
  return kBadInput;
}

int run(int count, const char* const* arguments) {
  CLI::App program("Benchmarks ray tracing acceleration techniques", "rayshoot");
  program.require_subcommand(1);
  int status = 0;
  add_compare(program, status);
  add_merge(program);
  add_rays(program);
  add_render(program);
  add_report(program);
  const std::string command_line = fmt::format("{}", fmt::join(arguments, arguments + count, " "));
  add_run(program, command_line, status);
  add_scene(program);
  add_scenes(program);
  add_table(program);
  add_techniques(program);
  add_torture(program, command_line, status);
  add_validate(program, status);
  try {
    program.parse(count, arguments);
  } catch (const CLI::Success& help) {
    return program.exit(help);
  } catch (const CLI::ParseError& error) {
    return fail(explain(program, error));
  } catch (const std::bad_alloc&) {
    return fail("out of memory");
  } catch (const std::runtime_error& error) {  // InputError, ReportError, and what the system refuses
    return fail(error.what());
  }
  return status;
}

}  // namespace

}  // namespace rayshoot::cli

int main(int count, char** arguments) { return rayshoot::cli::run(count, arguments); }
