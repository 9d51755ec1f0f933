#pragma once

#include <fmt/format.h>

#include <functional>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "scenes/core/spec.h"

/// What the readers of suites and of published figures share.
namespace rayshoot {

using Json = nlohmann::ordered_json;

/// A place in a file, for messages: "suite quick: scenes[2]".
struct Place {
  std::string path;

  Place operator/(const std::string& member) const { return {path + ": " + member}; }
  Place operator[](std::size_t index) const { return {fmt::format("{}[{}]", path, index)}; }
  InputError refuse(const std::string& why) const { return InputError(path + ": " + why); }
};

/// How to read each member of an object; a member without an entry is an error.
using Readers = std::map<std::string, std::function<void(const Json&, const Place&)>>;

inline void read_object(const Json& json, const Place& place, const Readers& readers) {
  if (!json.is_object()) throw place.refuse("must be an object");
  std::vector<std::string> known;
  for (const auto& reader : readers) known.push_back(reader.first);
  for (const auto& [member, value] : json.items()) {
    const auto reader = readers.find(member);
    if (reader == readers.end()) throw place.refuse(unknown_name("member", member, known));
    reader->second(value, place / member);
  }
}

template <class Number>
auto number(Number& target, double minimum, double maximum) {
  return [&target, minimum, maximum](const Json& json, const Place& place) {
    const bool fits = std::is_integral_v<Number> ? json.is_number_integer() : json.is_number();
    if (!fits || json.get<double>() < minimum || json.get<double>() > maximum)
      throw place.refuse(fmt::format("{} is not accepted; it takes {} {:g} to {:g}", json.dump(),
                                     std::is_integral_v<Number> ? "an integer" : "a number", minimum,
                                     maximum));
    target = json.get<Number>();
  };
}

template <class Number>
auto optional_number(std::optional<Number>& target, double minimum, double maximum) {
  return [&target, minimum, maximum](const Json& json, const Place& place) {
    number(target.emplace(), minimum, maximum)(json, place);
  };
}

inline std::string text_of(const Json& json, const Place& place) {
  if (!json.is_string()) throw place.refuse(fmt::format("{} is not accepted; it takes text", json.dump()));
  return json.get<std::string>();
}

inline auto text(std::string& target) {
  return [&target](const Json& json, const Place& place) { target = text_of(json, place); };
}

inline auto flag(bool& target) {
  return [&target](const Json& json, const Place& place) {
    if (!json.is_boolean())
      throw place.refuse(fmt::format("{} is not accepted; it takes true or false", json.dump()));
    target = json.get<bool>();
  };
}

/// A list, or one element that stands for a list of one; `read` is called for each element.
inline void for_each(const Json& json, const Place& place,
                     const std::function<void(const Json&, const Place&)>& read) {
  if (!json.is_array()) return read(json, place);
  if (json.empty()) throw place.refuse("the list is empty");
  for (std::size_t i = 0; i < json.size(); ++i) read(json[i], place[i]);
}

/// Parse JSON with comments; a member that is given twice is an error.
Json parse_json(const std::string& text, const Place& place);

}  // namespace rayshoot
