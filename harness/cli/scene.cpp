#include <fmt/format.h>
#include <fmt/ranges.h>

#include <memory>

#include "harness/cli/commands.h"
#include "harness/cli/listing.h"
#include "scenes/core/geometry.h"
#include "scenes/core/needs.h"
#include "scenes/io/load_scene.h"
#include "scenes/io/mesh.h"
#include "scenes/io/nff.h"

namespace rayshoot::cli {

namespace {

struct Options {
  std::string spec;
  std::optional<int> tessellation;
  std::string target;
  std::optional<int> precision;
  bool json = false;
};

/// Objects that cannot be traced in a precision, by reason.
template <class Real>
std::map<std::string, std::size_t> set_aside(const Scene& scene) {
  std::map<std::string, std::size_t> counts;
  const Geometry<Real> geometry(scene);
  for (const SetAside& object : geometry.set_aside()) ++counts[object.reason];
  return counts;
}

Json needs_json(const SceneNeeds& needs) {
  return {{"shadow_rays", needs.shadow_rays},
          {"reflected_rays", needs.reflected_rays},
          {"refracted_rays", needs.refracted_rays},
          {"curved_objects", needs.curved_objects},
          {"triangles_only", needs.triangles_only},
          {"placed_parts", needs.placed_parts},
          {"motion", needs.motion}};
}

Json topology_json(const MeshTopology& topology) {
  return {{"closed", topology.closed},
          {"manifold", topology.manifold},
          {"faces", topology.faces},
          {"vertices", topology.vertices},
          {"boundary_edges", topology.boundary_edges},
          {"complex_faces", topology.complex_faces},
          {"components", topology.components}};
}

/// Everything there is to say about a scene; the text is this JSON in words.
Json statistics(const LoadedScene& loaded) {
  const Scene& scene = loaded.scene;
  Json json = {{"id", scene.id}, {"objects", scene.numbers()}};
  if (!loaded.generator.empty()) json["generator"] = loaded.generator;
  if (loaded.size) json["size"] = *loaded.size;
  if (!loaded.form.empty()) json["form"] = loaded.form;
  for (std::size_t kind = 0; kind < kObjectKindNames.size(); ++kind)
    json["counts"][kObjectKindNames[kind]] = scene.counts()[kind];
  if (const Box<double> box = scene.bounds(); !box.empty())
    json["bounds"] = {{"min", {box.lo.x, box.lo.y, box.lo.z}}, {"max", {box.hi.x, box.hi.y, box.hi.z}}};
  json["lights"] = scene.lights.size();
  json["materials"] = scene.materials.size();
  json["hash"] = scene_hash(scene);
  json["needs"] = needs_json(needs_of(scene));
  json["left_out"] = Json::array();
  for (const LeftOut& line : left_out(needs_of(scene)))
    json["left_out"].push_back({{"what", line.what}, {"why", line.why}});
  json["set_aside"] = {{"float", set_aside<float>(scene)}, {"double", set_aside<double>(scene)}};
  if (const auto topology = topology_of(scene)) json["topology"] = topology_json(*topology);
  return json;
}

/// "1 polygon, 91 spheres, 2 placed parts".
std::string kinds_in_words(const Scene& scene) {
  std::vector<std::string> words;
  for (std::size_t kind = 0; kind < kObjectKindNames.size(); ++kind)
    if (const std::size_t count = scene.counts()[kind]; count > 0) {
      std::string name = kObjectKindNames[kind];
      std::replace(name.begin(), name.end(), '_', ' ');
      words.push_back(fmt::format("{} {}{}", count, name, count == 1 ? "" : "s"));
    }
  return words.empty() ? "none" : fmt::format("{}", fmt::join(words, ", "));
}

/// "3 not finite, 1 zero area"; "none" without any.
std::string reasons_in_words(const Json& counts) {
  std::vector<std::string> words;
  for (const auto& [reason, count] : counts.items())
    words.push_back(fmt::format("{} {}", count.get<std::size_t>(), reason));
  return words.empty() ? "none" : fmt::format("{}", fmt::join(words, ", "));
}

std::string needs_in_words(const SceneNeeds& needs) {
  const auto words = needs_list(needs);
  return words.empty() ? "nothing" : fmt::format("{}", fmt::join(words, ", "));
}

std::string in_words(const MeshTopology& topology) {
  return fmt::format("{}, {}; {} faces, {} vertices, {} boundary edges, {} complex faces, {} component{}",
                     topology.closed ? "closed" : "open", topology.manifold ? "manifold" : "not manifold",
                     topology.faces, topology.vertices, topology.boundary_edges, topology.complex_faces,
                     topology.components, topology.components == 1 ? "" : "s");
}

void print_text(const LoadedScene& loaded) {
  const Json json = statistics(loaded);
  const auto line = [](const char* name, const std::string& value) {
    fmt::print("{:<12} {}\n", name, value);
  };
  line("scene", loaded.scene.id);
  line("objects", fmt::format("{} ({})", loaded.scene.numbers(), kinds_in_words(loaded.scene)));
  if (const Box<double> box = loaded.scene.bounds(); !box.empty())
    line("bounds", fmt::format("({:g}, {:g}, {:g}) to ({:g}, {:g}, {:g})", box.lo.x, box.lo.y, box.lo.z,
                               box.hi.x, box.hi.y, box.hi.z));
  line("lights", fmt::format("{}", loaded.scene.lights.size()));
  line("materials", fmt::format("{}", loaded.scene.materials.size()));
  line("needs", needs_in_words(needs_of(loaded.scene)));
  for (const Json& left : json["left_out"])
    line("left out", fmt::format("{}: {}", left["what"].get<std::string>(), left["why"].get<std::string>()));
  for (const char* scalar : {"float", "double"})
    line("set aside", fmt::format("{} in {}", reasons_in_words(json["set_aside"][scalar]), scalar));
  if (const auto topology = topology_of(loaded.scene)) line("topology", in_words(*topology));
  line("hash", scene_hash(loaded.scene));
}

/// Write the scene in the format that the target's ending names.
void write(const Scene& scene, const Options& options) {
  if (options.target.ends_with(".nff"))
    return write_nff(scene, options.target, options.precision.value_or(6));
  if (options.precision) throw InputError("--precision goes with a target that ends in .nff");
  write_mesh(scene, options.target, options.tessellation.value_or(SceneOptions{}.tessellation));
}

void scene_command(const Options& options) {
  if (options.precision && options.target.empty()) throw InputError("--precision goes with --export");
  const LoadedScene loaded = load_scene(options.spec, options.tessellation);
  if (!options.target.empty()) return write(loaded.scene, options);
  if (options.json)
    fmt::print("{}\n", statistics(loaded).dump(2));
  else
    print_text(loaded);
}

}  // namespace

void add_scene(CLI::App& program) {
  auto* command = program.add_subcommand("scene", "Print the statistics of a scene, or write it to a file");
  const auto options = std::make_shared<Options>();
  command->add_option("SPEC", options->spec, "name, name:size, name:size/patches or a file")->required();
  command->add_option("--tessellation", options->tessellation, "Resolution of the patches of curved objects")
      ->check(CLI::Range(1, 1000));
  command->add_option("--export", options->target, "File to write, ending in .nff .obj .ply .off or .stl");
  command->add_option("--precision", options->precision, "Significant digits of an .nff file")
      ->check(CLI::Range(1, 17));
  command->add_flag("--json", options->json, "Print JSON");
  command->callback([options] { scene_command(*options); });
}

}  // namespace rayshoot::cli
