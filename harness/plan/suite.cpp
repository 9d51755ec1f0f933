#include "harness/plan/suite.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <limits>
#include <sstream>

#include "harness/plan/builtin.h"
#include "harness/plan/suite_json.h"

namespace rayshoot {

namespace {

/// A parameter's value as it is written in a specification.
std::string value_text(const Json& json, const Place& place) {
  if (json.is_boolean()) return json.get<bool>() ? "on" : "off";
  if (json.is_number()) return json.dump();
  return text_of(json, place);
}

/// A specification with parameters chosen so far.
struct PartialSpec {
  std::string name, size, form, arguments;

  std::string text() const {
    return name + (size.empty() ? "" : ":" + size) + (arguments.empty() ? "" : "(" + arguments + ")") +
           (form.empty() ? "" : "/" + form);
  }
  PartialSpec with(const std::string& key, const std::string& value) const {
    PartialSpec result = *this;
    if (key == "size")
      result.size = value;
    else if (key == "form")
      result.form = value;
    else
      result.arguments += (arguments.empty() ? "" : ",") + key + "=" + value;
    return result;
  }
};

/// {"name": "grid", "density": [1, 2], "mailbox": "on"}: one specification for every combination of values.
std::vector<std::string> combinations(const Json& json, const Place& place) {
  if (!json.contains("name")) throw place.refuse("has no member 'name'");
  std::vector<PartialSpec> specs{{.name = text_of(json["name"], place / "name")}};
  for (const auto& [key, values] : json.items()) {
    if (key == "name") continue;
    std::vector<PartialSpec> longer;
    for_each(values, place / key, [&, &name = key](const Json& value, const Place& where) {
      for (const PartialSpec& spec : specs) longer.push_back(spec.with(name, value_text(value, where)));
    });
    specs = std::move(longer);
  }
  std::vector<std::string> texts;
  for (const PartialSpec& spec : specs) texts.push_back(spec.text());
  return texts;
}

auto specifications(std::vector<std::string>& target) {
  return [&target](const Json& json, const Place& place) {
    target.clear();
    for_each(json, place, [&](const Json& entry, const Place& where) {
      const auto texts = entry.is_object() ? combinations(entry, where) : std::vector{text_of(entry, where)};
      target.insert(target.end(), texts.begin(), texts.end());
    });
  };
}

auto bounds_rule(BoundsRule& target) {
  return [&target](const Json& json, const Place& place) {
    const std::string name = text_of(json, place);
    const std::vector<std::string> known(kBoundsRuleNames.begin(), kBoundsRuleNames.end());
    const auto found = std::find(known.begin(), known.end(), name);
    if (found == known.end()) throw place.refuse(unknown_name("bounds rule", name, known));
    target = static_cast<BoundsRule>(found - known.begin());
  };
}

auto integers(std::vector<int>& target, double minimum, double maximum) {
  return [&target, minimum, maximum](const Json& json, const Place& place) {
    target.clear();
    for_each(json, place, [&](const Json& entry, const Place& where) {
      number(target.emplace_back(), minimum, maximum)(entry, where);
    });
  };
}

auto exclusions(std::vector<Exclusion>& target) {
  return [&target](const Json& json, const Place& place) {
    for_each(json, place, [&](const Json& entry, const Place& where) {
      constexpr double any = static_cast<double>(std::numeric_limits<std::int64_t>::max());
      Exclusion& exclusion = target.emplace_back();
      read_object(entry, where,
                  {{"scene", text(exclusion.scene)},
                   {"rays", text(exclusion.rays)},
                   {"technique", text(exclusion.technique)},
                   {"scalar", text(exclusion.scalar)},
                   {"intersector", text(exclusion.intersector)},
                   {"objects_over", number(exclusion.objects_over, 0, any)},
                   {"rays_over", number(exclusion.rays_over, 0, any)},
                   {"why", text(exclusion.why)}});
    });
  };
}

Readers suite_readers(Suite& suite) {
  constexpr double any = 1e18;
  return {{"scenes", specifications(suite.scenes)},
          {"rays", specifications(suite.rays)},
          {"techniques", specifications(suite.techniques)},
          {"scalars", specifications(suite.scalars)},
          {"intersectors", specifications(suite.intersectors)},
          {"exclude", exclusions(suite.exclude)},
          {"bounds", bounds_rule(suite.bounds)},
          {"published", text(suite.published)},
          {"seed", number(suite.seed, 0, any)},
          {"resolution", optional_number(suite.resolution, 1, 16384)},
          {"rules", [&suite](const Json& json, const Place& place) { suite.rules = text_of(json, place); }},
          {"tessellation", optional_number(suite.tessellation, 1, 1000)},
          {"threads", number(suite.threads, 1, 1024)},
          {"thread_scaling", integers(suite.thread_scaling, 1, 1024)},
          {"counts_only", flag(suite.counts_only)},
          {"repetitions", number(suite.repetitions, 1, 1000)},
          {"build_seconds", number(suite.build_seconds, 0, any)},
          {"trace_seconds", number(suite.trace_seconds, 0, any)},
          {"check_tests", number(suite.check_tests, 0, any)},
          {"graded_rays", number(suite.graded_rays, 0, any)},
          {"target_m_error", number(suite.target_m_error, 1e-4, 1)},
          {"work_maps", specifications(suite.work_maps)},
          {"strict_tests", number(suite.strict_tests, 0, any)}};
}

}  // namespace

Suite parse_suite(const std::string& text, const std::string& name) {
  const Place place{"suite " + name};
  Suite suite;
  suite.name = name;
  read_object(parse_json(text, place), place, suite_readers(suite));
  if (suite.scenes.empty() && suite.published.empty()) throw place.refuse("has no scenes");
  return suite;
}

std::vector<std::string> builtin_suites() {
  std::vector<std::string> names;
  for (const auto& entry : builtin_suite_texts()) names.push_back(entry.first);
  return names;
}

Suite load_suite(const std::string& name_or_path) {
  const auto builtin = builtin_suite_texts().find(name_or_path);
  if (builtin != builtin_suite_texts().end()) return parse_suite(builtin->second, builtin->first);
  if (!std::filesystem::exists(name_or_path))
    throw InputError(unknown_name("suite", name_or_path, builtin_suites()) + "; or the path of a suite file");
  std::ifstream file(name_or_path);
  std::ostringstream text;
  if (!(text << file.rdbuf())) throw InputError(fmt::format("{}: cannot be read", name_or_path));
  return parse_suite(text.str(), name_or_path);
}

}  // namespace rayshoot
