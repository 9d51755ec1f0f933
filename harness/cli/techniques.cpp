#include <fmt/format.h>
#include <fmt/ranges.h>

#include <memory>

#include "harness/cli/commands.h"
#include "harness/cli/listing.h"
#include "harness/plan/catalogue.h"

namespace rayshoot::cli {

namespace {

std::vector<std::string> scalars(const TechniqueEntry& entry) {
  std::vector<std::string> names;
  if (entry.supports<float>()) names.push_back("float");
  if (entry.supports<double>()) names.push_back("double");
  return names;
}

/// What a technique asks of a scene or a run, in words.
std::vector<std::string> needs(const TechniqueEntry& entry) {
  std::vector<std::string> words;
  if (entry.info.max_practical_objects != UINT64_MAX)
    words.push_back(fmt::format("at most {} objects", entry.info.max_practical_objects));
  if (entry.info.needs_recorded_hits) words.push_back("recorded hits");
  if (!entry.supports<double>()) words.push_back("float");
  if (!entry.supports<float>()) words.push_back("double");
  return words;
}

void print_json() {
  Json list = Json::array();
  for (const TechniqueEntry* entry : catalogue()) {
    const TechniqueInfo& info = entry->info;
    list.push_back({{"id", info.id},
                    {"title", info.title},
                    {"family", info.family},
                    {"survey_section", info.survey_section},
                    {"paper", info.paper},
                    {"baseline", info.baseline},
                    {"scalars", scalars(*entry)},
                    {"parameters", parameters_json(info.parameters)},
                    {"needs", needs(*entry)}});
  }
  fmt::print("{}\n", list.dump(2));
}

void print_text() {
  for (const TechniqueEntry* entry : catalogue()) {
    const TechniqueInfo& info = entry->info;
    const auto needed = needs(*entry);
    fmt::print("{:<22} {}. {}{}. Parameters: {}. Needs: {}.\n", info.id, info.title,
               info.survey_section.empty() ? "" : fmt::format("Survey §{}; ", info.survey_section),
               info.paper, parameters_text(info.parameters),
               needed.empty() ? "nothing" : fmt::format("{}", fmt::join(needed, ", ")));
  }
}

}  // namespace

void add_techniques(CLI::App& program) {
  auto* command = program.add_subcommand("techniques", "List the techniques and their parameters");
  const auto json = std::make_shared<bool>(false);
  command->add_flag("--json", *json, "Print JSON");
  command->callback([json] { *json ? print_json() : print_text(); });
}

}  // namespace rayshoot::cli
