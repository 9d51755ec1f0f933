#include "scenes/io/load_scene.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <filesystem>
#include <fstream>

#include "scenes/core/memory.h"
#include "scenes/io/mesh.h"
#include "scenes/io/nff.h"

namespace rayshoot {

namespace {

/// Objects are numbered in 29 bits where a technique refers to them together with their kind.
constexpr double kMostObjects = 1u << 29;

/// A triangle with vertex normals takes 160 bytes of a scene, growing vectors half as much again, and the
/// same triangle compiled for tracing in double precision 80.
constexpr double kBytesPerObject = 320;

constexpr std::array kFileEndings = {".nff", ".obj", ".ply", ".off", ".stl"};

std::string ending_of(const std::string& path) {
  std::string ending = std::filesystem::path(path).extension().string();
  std::transform(ending.begin(), ending.end(), ending.begin(),
                 [](unsigned char c) { return std::tolower(c); });
  return ending;
}

bool names_file(const std::string& spec) {
  return std::find(kFileEndings.begin(), kFileEndings.end(), ending_of(spec)) != kFileEndings.end();
}

const SceneGenerator& find_generator(const std::string& id) {
  std::vector<std::string> known;
  for (const SceneGenerator* generator : scene_generators()) {
    if (generator->id == id) return *generator;
    known.push_back(generator->id);
  }
  throw InputError(fmt::format("{}; or a file ending in {}", unknown_name("scene", id, known),
                               fmt::join(kFileEndings, " ")));
}

/// What every generator accepts, then what this one adds.
std::vector<Parameter> parameters_of(const SceneGenerator& generator) {
  std::vector<Parameter> parameters = {
      integer_parameter("size", generator.default_size, generator.min_size, 1e9, "size factor"),
      choice_parameter("form", "curves", {"curves", "patches"}, "curved objects as such, or as triangles"),
      integer_parameter("tessellation", SceneOptions{}.tessellation, 1, 1000, "resolution of patches")};
  parameters.insert(parameters.end(), generator.parameters.begin(), generator.parameters.end());
  return parameters;
}

/// The arguments of a specification under the names of parameters, wherever it wrote them.
std::map<std::string, std::string> named_arguments(const Spec& spec, std::optional<int> tessellation) {
  std::map<std::string, std::string> given = spec.arguments;
  for (const auto& [key, value] : {std::pair{"size", spec.size}, std::pair{"form", spec.form}})
    if (!value.empty() && !given.emplace(key, value).second)
      throw InputError(fmt::format("{}: the {} is given twice", spec.name, key));
  const auto form = given.find("form");
  const bool patches = form != given.end() && form->second == "patches";
  if (given.contains("tessellation") && !patches)
    throw InputError(
        fmt::format("{}: a tessellation goes with the form patches, as in {}/patches(tessellation={})",
                    spec.name, spec.name, given["tessellation"]));
  if (tessellation && patches) given.emplace("tessellation", std::to_string(*tessellation));
  return given;
}

std::string canonical_id(const std::string& name, const std::vector<Parameter>& parameters,
                         const Arguments& arguments) {
  std::vector<std::string> list;
  for (const Parameter& parameter : parameters) {
    const std::string value = text_of(arguments.values().at(parameter.name));
    const bool shown_before = parameter.name == "size" || parameter.name == "form";
    if (!shown_before && value != parameter.default_value) list.push_back(parameter.name + "=" + value);
  }
  return fmt::format("{}:{}/{}{}", name, arguments.integer("size"), arguments.text("form"),
                     list.empty() ? "" : fmt::format("({})", fmt::join(list, ",")));
}

/// A specification of a generated scene, understood and found to fit into memory.
struct Recipe {
  const SceneGenerator& generator;
  Arguments arguments;
  SceneOptions options;
  std::string id;
};

/// Throws InputError unless the objects, those of placed parts one by one, can be numbered.
void check_numbers(const std::string& id, double objects) {
  if (objects >= kNoObject)
    throw InputError(fmt::format("{} would have {:.3g} objects; hits tell at most {:.3g} apart", id, objects,
                                 static_cast<double>(kNoObject)));
}

Recipe resolve(const Spec& spec, std::optional<int> tessellation) {
  const SceneGenerator& generator = find_generator(spec.name);
  const std::vector<Parameter> parameters = parameters_of(generator);
  const Arguments arguments(parameters, named_arguments(spec, tessellation), spec.name);
  const bool patches = arguments.text("form") == "patches";
  const SceneOptions options{.size = static_cast<int>(arguments.integer("size")),
                             .form = patches ? SceneForm::patches : SceneForm::curves,
                             .tessellation = static_cast<int>(arguments.integer("tessellation"))};
  const std::string id = canonical_id(spec.name, parameters, arguments);
  const auto stored = generator.stored_objects ? generator.stored_objects : generator.object_count;
  check_object_count(id, stored(options, arguments), physical_memory());
  check_numbers(id, generator.object_count(options, arguments));
  return {generator, arguments, options, id};
}

LoadedScene generate_scene(const Recipe& recipe) {
  SceneBuilder builder(recipe.options);
  recipe.generator.generate(recipe.options, recipe.arguments, builder);
  LoadedScene loaded{std::move(builder).finish(), recipe.generator.id, recipe.options.size,
                     recipe.arguments.text("form")};
  loaded.scene.id = recipe.id;
  return loaded;
}

LoadedScene read_scene(const std::string& path) {
  LoadedScene loaded{.scene = ending_of(path) == ".nff" ? read_nff(path) : read_mesh(path)};
  loaded.scene.id = path;
  return loaded;
}

}  // namespace

void check_object_count(const std::string& id, double objects, double memory) {
  constexpr double kGibibyte = 1 << 30;
  if (objects > kMostObjects)
    throw InputError(
        fmt::format("{} would have {:.3g} objects and need about {:.3g} GiB; a scene holds at most {:.0f}",
                    id, objects, objects * kBytesPerObject / kGibibyte, kMostObjects));
  if (objects * kBytesPerObject > memory)
    throw InputError(
        fmt::format("{} would have {:.3g} objects and need about {:.3g} GiB; this machine has {:.3g} GiB", id,
                    objects, objects * kBytesPerObject / kGibibyte, memory / kGibibyte));
}

LoadedScene load_scene(const std::string& spec, std::optional<int> tessellation) {
  if (names_file(spec)) return read_scene(spec);
  return generate_scene(resolve(parse_spec(spec), tessellation));
}

std::string scene_id(const std::string& spec, std::optional<int> tessellation) {
  if (!names_file(spec)) return resolve(parse_spec(spec), tessellation).id;
  if (!std::ifstream(spec)) throw InputError(fmt::format("{}: cannot be read", spec));
  return spec;
}

}  // namespace rayshoot
