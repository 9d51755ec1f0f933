#pragma once

#include <CLI/CLI.hpp>

/// One function a command, each in the file of its name: it declares the command's options and what it does.
namespace rayshoot::cli {

void add_rays(CLI::App& program);
void add_scenes(CLI::App& program);
void add_techniques(CLI::App& program);

}  // namespace rayshoot::cli
