#include "harness/choose/constants.h"

#include <cmath>

#include "harness/choose/terms.h"
#include "harness/plan/suite_json.h"

namespace rayshoot {

namespace {

template <class Names>
auto terms(std::map<std::string, double>& target, const Names& names) {
  return [&target, names](const Json& json, const Place& place) {
    Readers readers;
    for (const char* name : names)
      readers[name] = [&target, name](const Json& value, const Place& where) {
        number(target[name], 0, 1e9)(value, where);
      };
    read_object(json, place, readers);
  };
}

auto techniques(std::map<std::string, TechniqueConstants>& target) {
  return [&target](const Json& json, const Place& place) {
    if (!json.is_object()) throw place.refuse("must be an object");
    for (const auto& [name, value] : json.items()) {
      TechniqueConstants& technique = target[name];
      read_object(value, place / name,
                  {{"terms_ns", terms(technique.terms_ns, kTechniqueTerms)},
                   {"at_least", number(technique.at_least, 1, 1e9)},
                   {"on_average", number(technique.on_average, 1, 1e9)},
                   {"error", number(technique.error, 0, 1e9)}});
    }
  };
}

/// Four significant digits, so that files are readable and differences too.
double rounded(double value) { return std::stod(fmt::format("{:.3e}", value)); }

Json json_of(const std::map<std::string, double>& terms) {
  Json json = Json::object();
  for (const auto& [name, value] : terms) json[name] = rounded(value);
  return json;
}

}  // namespace

const TechniqueConstants* Constants::find(const std::string& technique) const {
  const auto found = techniques.find(technique);
  return found == techniques.end() ? nullptr : &found->second;
}

double Constants::predicted_ns(const TechniqueConstants& technique,
                               const std::map<std::string, double>& counts) const {
  double sum = 0;
  for (const auto& [term, count] : counts)
    for (const auto* constants : {&object_terms_ns, &technique.terms_ns})
      if (const auto constant = constants->find(term); constant != constants->end())
        sum += constant->second * count;
  return sum;
}

std::string Constants::origin() const { return fmt::format("{}, {}, {} cells", machine, date, cells); }

Constants parse_constants(const std::string& text_of_file, const std::string& name) {
  const Place place{name};
  Constants constants;
  read_object(parse_json(text_of_file, place), place,
              {{"machine", text(constants.machine)},
               {"date", text(constants.date)},
               {"cells", number(constants.cells, 0, 1e9)},
               {"scenes",
                [&](const Json& json, const Place& where) {
                  if (!json.is_array() || !json.empty())
                    for_each(json, where, [&](const Json& scene, const Place& here) {
                      constants.scenes.push_back(text_of(scene, here));
                    });
                }},
               {"object_terms_ns", terms(constants.object_terms_ns, kObjectTerms)},
               {"techniques", techniques(constants.techniques)}});
  return constants;
}

std::string to_json(const Constants& constants) {
  Json techniques = Json::object();
  for (const auto& [name, technique] : constants.techniques)
    techniques[name] = {{"terms_ns", json_of(technique.terms_ns)},
                        {"at_least", rounded(technique.at_least)},
                        {"on_average", rounded(technique.on_average)},
                        {"error", rounded(technique.error)}};
  const Json json{{"machine", constants.machine},
                  {"date", constants.date},
                  {"cells", constants.cells},
                  {"scenes", constants.scenes},
                  {"object_terms_ns", json_of(constants.object_terms_ns)},
                  {"techniques", std::move(techniques)}};
  return json.dump(1) + '\n';
}

}  // namespace rayshoot
