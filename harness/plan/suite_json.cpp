#include "harness/plan/suite_json.h"

#include <set>

namespace rayshoot {

Json parse_json(const std::string& text, const Place& place) {
  std::vector<std::set<std::string>> members;
  const auto watch = [&](int, Json::parse_event_t event, Json& parsed) {
    if (event == Json::parse_event_t::object_start) members.emplace_back();
    if (event == Json::parse_event_t::object_end) members.pop_back();
    if (event == Json::parse_event_t::key && !members.back().insert(parsed.get<std::string>()).second)
      throw place.refuse(fmt::format("member '{}' is given twice", parsed.get<std::string>()));
    return true;
  };
  try {
    return Json::parse(text, watch, /*allow_exceptions=*/true, /*ignore_comments=*/true);
  } catch (const Json::parse_error& error) {
    const std::string message = error.what();
    throw place.refuse("not JSON:" + message.substr(message.find(']') + 1));
  }
}

}  // namespace rayshoot
