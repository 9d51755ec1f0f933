#include "harness/render/render.h"

#include <fmt/format.h>

#include <memory>
#include <thread>

#include "harness/cli/commands.h"
#include "harness/cli/writable.h"
#include "harness/plan/catalogue.h"
#include "scenes/io/load_scene.h"

namespace rayshoot::cli {

namespace {

struct Options {
  std::string scene, technique = "bvh_sah", show = "shaded", target;
  int width = 0, height = 0;
};

void render_command(const Options& options) {
  const TechniqueChoice technique = choose_technique(options.technique);
  const RenderOptions how{.show = show_named(options.show),
                          .width = options.width,
                          .height = options.height,
                          .threads = static_cast<int>(std::max(1u, std::thread::hardware_concurrency()))};
  if (!options.target.ends_with(".png"))
    throw InputError(fmt::format("{}: a picture's name ends in .png", options.target));
  require_writable(options.target);
  const Scene scene = load_scene(options.scene).scene;
  write_png(render(scene, *technique.entry, technique.arguments, how), options.target);
}

}  // namespace

void add_render(CLI::App& program) {
  auto* command = program.add_subcommand("render", "Draw a scene, or the work that it takes, pixel by pixel");
  const auto options = std::make_shared<Options>();
  command->add_option("SCENE", options->scene, "name, name:size, name:size/patches or a file")->required();
  command->add_option("--technique", options->technique, "Technique that traces the rays");
  command->add_option("--show", options->show, "shaded, tests or steps");
  command->add_option("--width", options->width, "Width in pixels");
  command->add_option("--height", options->height, "Height in pixels");
  command->add_option("-o,--output", options->target, "The picture, a .png file")->required();
  command->callback([options] { render_command(*options); });
}

}  // namespace rayshoot::cli
