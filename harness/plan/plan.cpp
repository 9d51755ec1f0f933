#include "harness/plan/plan.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <fnmatch.h>

#include <algorithm>

#include "scenes/io/load_scene.h"

namespace rayshoot {

namespace {

/// Rays of which a technique with a limit on objects is expected to be able to trace a batch at that limit.
constexpr double kPracticalRays = 50'000;

template <class Choice, class Key>
void append_new(std::vector<Choice>& choices, Choice choice, const Key& key) {
  const auto same = [&](const Choice& other) { return key(other) == key(choice); };
  if (std::none_of(choices.begin(), choices.end(), same)) choices.push_back(std::move(choice));
}

/// Settings of the suite that stand in for the defaults of ray distributions.
std::map<std::string, std::string> ray_defaults(const Suite& suite) {
  std::map<std::string, std::string> defaults;
  if (suite.resolution) defaults["resolution"] = std::to_string(*suite.resolution);
  if (suite.rules) defaults["rules"] = *suite.rules;
  return defaults;
}

std::vector<RaySpec> resolve_all_rays(const Suite& suite) {
  const auto defaults = ray_defaults(suite);
  std::vector<RaySpec> rays;
  for (const std::string& text : suite.rays)
    append_new(rays, resolve_rays(text, defaults), [](auto& r) { return r.id; });
  for (const auto& setting : defaults) {
    const auto takes = [&](const RaySpec& spec) { return spec.arguments.values().contains(setting.first); };
    if (std::none_of(rays.begin(), rays.end(), takes))
      throw InputError(fmt::format("no ray distribution of this run has a parameter '{}'", setting.first));
  }
  return rays;
}

/// The published figures of a suite, their scenes by id.
Published published_for(const Suite& suite) {
  if (suite.published.empty()) return {};
  Published published = load_published(suite.published);
  for (PublishedRow& row : published.rows) row.scene = scene_id(row.scene, suite.tessellation);
  for (PublishedClaim& claim : published.claims) {
    claim.scene = scene_id(claim.scene, suite.tessellation);
    for (const std::string* technique : {&claim.first, &claim.second}) choose_technique(*technique);
  }
  return published;
}

/// Append what published figures are about, each technique for its scenes.
void append_published(std::vector<TechniqueChoice>& techniques, const Published& published) {
  for (const PublishedRow& row : published.rows) {
    append_new(techniques, choose_technique(row.technique), [](auto& t) { return t.spec; });
    const auto same = [&](const TechniqueChoice& choice) { return choice.spec == row.technique; };
    append_new(std::find_if(techniques.begin(), techniques.end(), same)->scenes, row.scene,
               [](auto& id) { return id; });
  }
}

/// The techniques asked for; "all" stands for every one, "baselines" for the points of comparison, "published" for those
/// of the published figures.
std::vector<TechniqueChoice> choose_all_techniques(const Suite& suite, const Published& published) {
  std::vector<TechniqueChoice> techniques;
  const auto add = [&](const std::string& text) {
    append_new(techniques, choose_technique(text), [](auto& t) { return t.spec; });
  };
  for (const std::string& text : suite.techniques) {
    if (text == "published" && !suite.published.empty()) {
      append_published(techniques, published);
      continue;
    }
    if (text != "all" && text != "baselines") {
      add(text);
      continue;
    }
    for (const TechniqueEntry* entry : catalogue())
      if (text == "all" || entry->info.baseline) add(entry->info.id);
  }
  return techniques;
}

/// Distributions whose sets begin with a square of eye rays.
const std::vector<std::string> kBeginWithEyeRays{"primary", "whitted"};

bool begins_with_eye_rays(const RaySpec& rays) {
  return std::find(kBeginWithEyeRays.begin(), kBeginWithEyeRays.end(), rays.distribution->id) !=
         kBeginWithEyeRays.end();
}

/// What is to be mapped must run.
void check_work_maps(const Plan& plan) {
  if (plan.suite.work_maps.empty()) return;
  std::vector<std::string> known;
  for (const TechniqueChoice& technique : plan.techniques)
    for (const std::string& name : {technique.spec, technique.entry->info.id})
      append_new(known, name, [](auto& n) { return n; });
  require_known("technique of this run", plan.suite.work_maps, known);
  if (std::none_of(plan.rays.begin(), plan.rays.end(), begins_with_eye_rays))
    throw InputError(
        fmt::format("work is mapped for eye rays, and this run has none; rays that begin with them: {}",
                    fmt::join(kBeginWithEyeRays, ", ")));
}

bool matches(const std::string& pattern, const std::string& text) {
  return fnmatch(pattern.c_str(), text.c_str(), 0) == 0;
}

bool matches(const Exclusion& exclusion, const CellFacts& cell) {
  const auto either = [&](const std::string& id, const std::string& spec) {
    return matches(exclusion.technique, id) || matches(exclusion.technique, spec);
  };
  return matches(exclusion.scene, cell.scene.id) && matches(exclusion.rays, cell.rays.id) &&
         either(cell.technique.entry->info.id, cell.technique.spec) &&
         matches(exclusion.scalar, cell.scalar) && matches(exclusion.intersector, cell.intersector) &&
         (exclusion.objects_over == 0 || cell.scene.numbers() > exclusion.objects_over) &&
         (exclusion.rays_over == 0 || cell.ray_count > exclusion.rays_over);
}

/// Why a technique cannot serve, or not in reasonable time; empty when it can.
std::string beyond_technique(const CellFacts& cell) {
  const TechniqueEntry& entry = *cell.technique.entry;
  if (!(cell.scalar == "float" ? entry.supports<float>() : entry.supports<double>()))
    return fmt::format("{} does not trace in {}", entry.info.id, cell.scalar);
  if (!cell.scene.placements.empty() && !entry.searches_parts())
    return fmt::format("{} does not search placed parts", entry.info.id);
  if (entry.info.max_practical_objects == UINT64_MAX) return {};
  const double limit = static_cast<double>(entry.info.max_practical_objects);
  const double objects = static_cast<double>(cell.scene.numbers()),
               rays = static_cast<double>(cell.ray_count);
  if (objects > limit) return fmt::format("{} objects; {:g} are practical", cell.scene.numbers(), limit);
  if (objects * rays > limit * kPracticalRays)
    return fmt::format("{:.1e} pairs of ray and object; {:.1e} are practical", objects * rays,
                       limit * kPracticalRays);
  return {};
}

}  // namespace

Plan make_plan(Suite suite) {
  require_known("scalar", suite.scalars, {"float", "double"});
  require_known("intersector", suite.intersectors, {kIntersectorNames.begin(), kIntersectorNames.end()});
  Plan plan{.suite = std::move(suite)};
  plan.published = published_for(plan.suite);
  if (plan.suite.scenes.empty())
    for (const PublishedRow& row : plan.published.rows) plan.suite.scenes.push_back(row.scene);
  // Name each scene canonically, and only once.
  std::vector<std::string> ids;
  for (const std::string& spec : plan.suite.scenes)
    append_new(ids, scene_id(spec, plan.suite.tessellation), [](auto& id) { return id; });
  plan.suite.scenes = std::move(ids);
  plan.rays = resolve_all_rays(plan.suite);
  plan.techniques = choose_all_techniques(plan.suite, plan.published);
  check_work_maps(plan);
  return plan;
}

bool is_mapped(const Suite& suite, const TechniqueChoice& technique, const RaySpec& rays) {
  return begins_with_eye_rays(rays) &&
         std::any_of(suite.work_maps.begin(), suite.work_maps.end(), [&](const std::string& name) {
           return name == technique.spec || name == technique.entry->info.id;
         });
}

bool is_planned(const TechniqueChoice& technique, const std::string& scene) {
  return technique.scenes.empty() ||
         std::find(technique.scenes.begin(), technique.scenes.end(), scene) != technique.scenes.end();
}

std::size_t Plan::cells() const {
  std::size_t pairs = 0;
  for (const std::string& scene : suite.scenes)
    pairs += static_cast<std::size_t>(
        std::count_if(techniques.begin(), techniques.end(),
                      [&](const TechniqueChoice& technique) { return is_planned(technique, scene); }));
  return pairs * rays.size() * suite.scalars.size() * suite.intersectors.size();
}

std::string why_left_out(const Suite& suite, const CellFacts& cell) {
  const std::string no_rays = why_left_out(cell.rays, cell.scene);
  if (!no_rays.empty()) return no_rays;
  for (const Exclusion& exclusion : suite.exclude)
    if (matches(exclusion, cell)) return exclusion.why;
  if (cell.technique.entry->info.own_object_test && cell.intersector != suite.intersectors.front())
    return fmt::format("{} has an object test of its own: see {}", cell.technique.entry->info.id,
                       suite.intersectors.front());
  return beyond_technique(cell);
}

}  // namespace rayshoot
