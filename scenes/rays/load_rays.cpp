#include "scenes/rays/load_rays.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

namespace rayshoot {

namespace {

const RayDistribution& find_distribution(const std::string& id) {
  std::vector<std::string> known;
  for (const RayDistribution* distribution : ray_distributions()) {
    if (distribution->id == id) return *distribution;
    known.push_back(distribution->id);
  }
  throw InputError(unknown_name("ray distribution", id, known));
}

/// The specification with `@N` rewritten as the argument resolution=N.
Spec parse_ray_spec(const std::string& text) {
  const auto at = text.rfind('@');
  Spec spec = parse_spec(text.substr(0, at));
  if (!spec.size.empty() || !spec.form.empty())
    throw InputError(
        fmt::format("'{}': rays have neither size nor form; write name(key=value,...)@resolution", text));
  if (at != std::string::npos && !spec.arguments.emplace("resolution", text.substr(at + 1)).second)
    throw InputError(fmt::format("'{}': the resolution is given twice", text));
  return spec;
}

/// What distinguishes rays from others of their distribution: their number, and whatever is not as the
/// distribution has it by default.
std::string canonical_id(const RayDistribution& distribution, const Arguments& arguments) {
  std::vector<std::string> list;
  std::string resolution;
  for (const Parameter& parameter : distribution.parameters) {
    const std::string value = text_of(arguments.values().at(parameter.name));
    if (parameter.name == "resolution")
      resolution = "@" + value;
    else if (parameter.name == "rays" || value != parameter.default_value)
      list.push_back(parameter.name + "=" + value);
  }
  const std::string in_parentheses = list.empty() ? "" : fmt::format("({})", fmt::join(list, ","));
  return distribution.id + in_parentheses + resolution;
}

}  // namespace

RaySpec resolve_rays(const std::string& text, const std::map<std::string, std::string>& defaults) {
  Spec spec = parse_ray_spec(text);
  RaySpec rays{.distribution = &find_distribution(spec.name)};
  for (const Parameter& parameter : rays.distribution->parameters)
    if (const auto found = defaults.find(parameter.name); found != defaults.end())
      spec.arguments.insert(*found);
  rays.arguments = Arguments(rays.distribution->parameters, spec.arguments, spec.name);
  rays.id = canonical_id(*rays.distribution, rays.arguments);
  return rays;
}

std::string why_left_out(const RaySpec& spec, const Scene& scene) {
  return spec.distribution->needs_lights && scene.lights.empty() ? "the scene has no point light" : "";
}

RaySet make_rays(const RaySpec& spec, const Scene& scene, const Tracer& tracer, std::uint64_t seed) {
  if (const std::string why = why_left_out(spec, scene); !why.empty())
    throw InputError(fmt::format("{}: no rays for {}: {}", spec.id, scene.id, why));
  RaySet set = spec.distribution->generate({scene, tracer, spec.arguments, seed});
  set.id = spec.id;
  set.distribution = spec.distribution->id;
  return set;
}

RaySet make_rays(const std::string& spec, const Scene& scene, const Tracer& tracer, std::uint64_t seed) {
  return make_rays(resolve_rays(spec), scene, tracer, seed);
}

}  // namespace rayshoot
