#include "harness/report/report.h"

#include <fmt/format.h>

#include <filesystem>
#include <fstream>
#include <list>
#include <memory>
#include <sstream>

#include "analysis/html/report_page.h"
#include "harness/cli/commands.h"
#include "scenes/core/spec.h"
#include "scenes/io/output_file.h"

namespace rayshoot::cli {

namespace {

constexpr const char* kEnding = ".html";

/// Where the page goes: as given, or beside the first report.
std::filesystem::path page_path(const std::string& given, const std::string& first_report) {
  if (given.empty()) return std::filesystem::path(first_report).replace_extension(kEnding);
  if (!given.ends_with(kEnding)) throw InputError(fmt::format("{}: a page ends in {}", given, kEnding));
  return given;
}

/// A picture from a file, called as the file is.
analysis::Picture read_picture(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  if (!file) throw InputError(fmt::format("{}: cannot be opened", path));
  std::ostringstream bytes;
  bytes << file.rdbuf();
  if (!bytes.str().starts_with("\x89PNG\r\n\x1a\n"))
    throw InputError(fmt::format("{}: not a PNG picture", path));
  return {std::filesystem::path(path).stem().string(), bytes.str()};
}

/// Write all of them or none: each is complete before the first one appears.
void write_files(const std::vector<std::pair<std::string, std::string>>& files) {
  std::list<OutputFile> opened;
  for (const auto& [path, text] : files) opened.emplace_back(path).stream() << text;
  for (OutputFile& file : opened) file.commit();
}

}  // namespace

void add_report(CLI::App& program) {
  struct Options {
    std::vector<std::string> reports, pictures;
    std::string output;
  };
  auto* command = program.add_subcommand("report", "Write a page of everything reports say, with plots");
  const auto options = std::make_shared<Options>();
  command->add_option("REPORT", options->reports, "Reports, as `run` and `torture` write them")->required();
  command->add_option(
      "-o,--output", options->output,
      "Where to write the page, FILE.html; beside the first report if not given. Plots go beside it");
  repeatable(command->add_option("--picture", options->pictures,
                                 "A PNG file to show on it, such as a heat map that `render` drew"));
  command->callback([options] {
    const std::filesystem::path page = page_path(options->output, options->reports.front());
    std::vector<analysis::Picture> pictures;
    for (const std::string& path : options->pictures) pictures.push_back(read_picture(path));
    std::vector<report::Report> reports;
    for (const std::string& path : options->reports) reports.push_back(report::read_report(path));
    const analysis::ReportPage made = analysis::report_page(reports, pictures);
    std::vector<std::pair<std::string, std::string>> files;
    for (const auto& [name, text] : made.plots)
      files.emplace_back((page.parent_path() / fmt::format("{}-{}", page.stem().string(), name)).string(),
                         text);
    files.emplace_back(page.string(), made.html);
    write_files(files);
    fmt::print("Page: {}, and {} plots beside it\n", page.string(), made.plots.size());
  });
}

}  // namespace rayshoot::cli
