#include <fmt/format.h>

#include <memory>

#include "harness/cli/commands.h"
#include "harness/cli/listing.h"
#include "scenes/rays/distribution.h"

namespace rayshoot::cli {

namespace {

void print_json() {
  Json list = Json::array();
  for (const RayDistribution* distribution : ray_distributions())
    list.push_back({{"id", distribution->id},
                    {"title", distribution->title},
                    {"source", distribution->source},
                    {"parameters", parameters_json(distribution->parameters)},
                    {"needs_lights", distribution->needs_lights}});
  fmt::print("{}\n", list.dump(2));
}

void print_text() {
  for (const RayDistribution* distribution : ray_distributions())
    fmt::print("{:<10} {}. {}. Parameters: {}. Needs: {}.\n", distribution->id, distribution->title,
               distribution->source, parameters_text(distribution->parameters),
               distribution->needs_lights ? "point lights" : "nothing");
}

}  // namespace

void add_rays(CLI::App& program) {
  auto* command = program.add_subcommand("rays", "List the ray distributions and their parameters");
  const auto json = std::make_shared<bool>(false);
  command->add_flag("--json", *json, "Print JSON");
  command->callback([json] { *json ? print_json() : print_text(); });
}

}  // namespace rayshoot::cli
