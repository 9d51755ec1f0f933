#pragma once

#include <CLI/CLI.hpp>

/// One function a command, each in the file of its name: it declares the command's options and what it does.
namespace rayshoot::cli {

/// Lets an option be given again and again, each time with one value.
inline CLI::Option* repeatable(CLI::Option* option) { return option->allow_extra_args(false); }

/// Sets `status` to the program's exit status.
void add_compare(CLI::App& program, int& status);
void add_merge(CLI::App& program);
void add_rays(CLI::App& program);
void add_render(CLI::App& program);
void add_report(CLI::App& program);
void add_scene(CLI::App& program);
/// Sets `status` to the program's exit status; `command_line` is what the report records.
void add_run(CLI::App& program, const std::string& command_line, int& status);
void add_scenes(CLI::App& program);
void add_table(CLI::App& program);
void add_techniques(CLI::App& program);
void add_torture(CLI::App& program, const std::string& command_line, int& status);
void add_validate(CLI::App& program, int& status);

}  // namespace rayshoot::cli
