#include "harness/cli/listing.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <array>

namespace rayshoot::cli {

Json parameters_json(const std::vector<Parameter>& parameters) {
  constexpr std::array type_names = {"integer", "real", "boolean", "choice", "text"};
  Json list = Json::array();
  for (const Parameter& parameter : parameters)
    list.push_back({{"name", parameter.name},
                    {"type", type_names[static_cast<std::size_t>(parameter.type)]},
                    {"default", parameter.default_value},
                    {"range", parameter.range()},
                    {"description", parameter.description}});
  return list;
}

std::string parameters_text(const std::vector<Parameter>& parameters) {
  std::vector<std::string> words;
  for (const Parameter& parameter : parameters)
    words.push_back(fmt::format("{}={} ({})", parameter.name, parameter.default_value, parameter.range()));
  return words.empty() ? "none" : fmt::format("{}", fmt::join(words, ", "));
}

std::vector<std::string> needs_list(const SceneNeeds& needs) {
  std::vector<std::string> words;
  if (needs.shadow_rays) words.push_back("shadow rays");
  if (needs.reflected_rays) words.push_back("reflected rays");
  if (needs.refracted_rays) words.push_back("refracted rays");
  if (needs.curved_objects) words.push_back("curved objects");
  if (needs.placed_parts) words.push_back("placed parts");
  if (needs.motion) words.push_back("motion");
  return words;
}

}  // namespace rayshoot::cli
