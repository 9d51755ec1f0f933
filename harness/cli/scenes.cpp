#include <fmt/format.h>
#include <fmt/ranges.h>

#include <memory>

#include "harness/cli/commands.h"
#include "harness/cli/listing.h"
#include "scenes/core/registry.h"

namespace rayshoot::cli {

namespace {

/// What a generator's scenes need, read off its smallest one: sizes differ in objects, not in kinds of work.
std::vector<std::string> needs(const SceneGenerator& generator) {
  const SceneOptions options{.size = generator.min_size};
  SceneBuilder builder(options);
  generator.generate(options, Arguments(generator.parameters, {}, generator.id), builder);
  return needs_list(needs_of(std::move(builder).finish()));
}

void print_json() {
  Json list = Json::array();
  for (const SceneGenerator* generator : scene_generators())
    list.push_back({{"id", generator->id},
                    {"title", generator->title},
                    {"source", generator->source},
                    {"purpose", generator->purpose},
                    {"default_size", generator->default_size},
                    {"min_size", generator->min_size},
                    {"parameters", parameters_json(generator->parameters)},
                    {"needs", needs(*generator)}});
  fmt::print("{}\n", list.dump(2));
}

void print_text() {
  for (const SceneGenerator* generator : scene_generators()) {
    const auto needed = needs(*generator);
    fmt::print("{:<10} {}. {}. {}. Size: {} (at least {}). Parameters: {}. Needs: {}.\n", generator->id,
               generator->title, generator->source, generator->purpose, generator->default_size,
               generator->min_size, parameters_text(generator->parameters),
               needed.empty() ? "nothing" : fmt::format("{}", fmt::join(needed, ", ")));
  }
}

}  // namespace

void add_scenes(CLI::App& program) {
  auto* command = program.add_subcommand("scenes", "List the procedural scenes and their parameters");
  const auto json = std::make_shared<bool>(false);
  command->add_flag("--json", *json, "Print JSON");
  command->callback([json] { *json ? print_json() : print_text(); });
}

}  // namespace rayshoot::cli
