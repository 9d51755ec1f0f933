#pragma once

#include <CLI/CLI.hpp>

#include "analysis/tables/table.h"

namespace rayshoot::cli {

/// The option that says how tables are printed.
inline CLI::Option* add_format(CLI::App& command, std::string& format) {
  std::vector<std::string> names;
  names.reserve(analysis::kFormats.size());
  for (const auto& [name, value] : analysis::kFormats) names.push_back(name);
  return command.add_option("--format", format, "text, markdown, csv or latex")->check(CLI::IsMember(names));
}

}  // namespace rayshoot::cli
