#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <limits>
#include <nlohmann/json.hpp>
#include <set>

#include "harness/report/members.h"

namespace rayshoot::report {

namespace {

using Json = nlohmann::json;

[[noreturn]] void fail(const std::string& path, const std::string& what) {
  throw ReportError(path.empty() ? what : fmt::format("{}: {}", path, what));
}

[[noreturn]] void expected(const std::string& path, const std::string& what, const Json& found) {
  fail(path,
       fmt::format("expected {}, found {}", what, found.is_primitive() ? found.dump() : found.type_name()));
}

std::string member_path(const std::string& path, const std::string& name) {
  return path.empty() ? name : fmt::format("{}.{}", path, name);
}

std::string element_path(const std::string& path, std::size_t index) {
  return fmt::format("{}[{}]", path, index);
}

void read(const Json& json, const std::string& path, std::string& text) {
  if (!json.is_string()) expected(path, "a string", json);
  text = json.get<std::string>();
}

void read(const Json& json, const std::string& path, bool& flag) {
  if (!json.is_boolean()) expected(path, "true or false", json);
  flag = json.get<bool>();
}

void read(const Json& json, const std::string& path, double& number) {
  if (!json.is_number()) expected(path, "a number", json);
  number = json.get<double>();
}

void read(const Json& json, const std::string& path, std::uint64_t& count) {
  if (!json.is_number_unsigned()) expected(path, "a whole number, 0 or more", json);
  count = json.get<std::uint64_t>();
}

void read(const Json& json, const std::string& path, std::int64_t& number) {
  const bool too_large = json.is_number_unsigned() && json.get<std::uint64_t>() > INT64_MAX;
  if (!json.is_number_integer() || too_large) expected(path, "a whole number of 64 bits", json);
  number = json.get<std::int64_t>();
}

template <class Object>
requires std::is_class_v<Object>
void read(const Json& json, const std::string& path, Object& object);

template <class Value>
Value read_as(const Json& json, const std::string& path) {
  Value value{};
  read(json, path, value);
  return value;
}

/// A number of threads or cores.
void read(const Json& json, const std::string& path, int& number) {
  const auto wide = read_as<std::uint64_t>(json, path);
  if (wide > std::numeric_limits<int>::max()) expected(path, "a whole number of 32 bits", json);
  number = static_cast<int>(wide);
}

template <class Names>
std::size_t read_choice(const Json& json, const std::string& path, const Names& names) {
  const auto found = std::find(names.begin(), names.end(), json.is_string() ? json.get<std::string>() : "");
  if (found == names.end()) expected(path, fmt::format("one of {}", fmt::join(names, ", ")), json);
  return static_cast<std::size_t>(found - names.begin());
}

void read(const Json& json, const std::string& path, Status& status) {
  status = static_cast<Status>(read_choice(json, path, kStatusNames));
}

void read(const Json& json, const std::string& path, ConfigValue& value) {
  if (json.is_boolean())
    value = read_as<bool>(json, path);
  else if (json.is_string())
    value = read_as<std::string>(json, path);
  else if (json.is_number_integer())
    value = read_as<std::int64_t>(json, path);
  else if (json.is_number())
    value = read_as<double>(json, path);
  else
    expected(path, "true, false, a number or a string", json);
}

template <std::size_t N>
void read(const Json& json, const std::string& path, std::array<double, N>& numbers) {
  if (!json.is_array() || json.size() != N) expected(path, fmt::format("a list of {} numbers", N), json);
  for (std::size_t i = 0; i < N; ++i) read(json[i], element_path(path, i), numbers[i]);
}

template <class Element>
void read(const Json& json, const std::string& path, std::vector<Element>& elements) {
  if (!json.is_array()) expected(path, "a list", json);
  elements.resize(json.size());
  for (std::size_t i = 0; i < json.size(); ++i) read(json[i], element_path(path, i), elements[i]);
}

template <class Value>
void read(const Json& json, const std::string& path, std::map<std::string, Value>& map) {
  if (!json.is_object()) expected(path, "an object", json);
  for (const auto& [key, value] : json.items()) read(value, member_path(path, key), map[key]);
}

class Reader {
 public:
  Reader(const Json& json, const std::string& path) : json_(json), path_(path) {
    if (!json.is_object()) expected(path, "an object", json);
  }

  template <class T>
  void required(const char* name, T& value) {
    read(present(name), member_path(path_, name), value);
  }
  template <class Names>
  void choice(const char* name, std::string& value, const Names& names) {
    value = names[read_choice(present(name), member_path(path_, name), names)];
  }
  template <class Names>
  void optional_choice(const char* name, std::string& value, const Names& names) {
    if (known(name) != json_.end()) choice(name, value, names);
  }
  template <class T>
  void optional(const char* name, std::optional<T>& value) {
    if (known(name) != json_.end()) required(name, value.emplace());
  }
  /// A list or a map, empty where it is absent.
  template <class T>
  void optional(const char* name, T& values) {
    if (known(name) != json_.end()) required(name, values);
  }

  /// Call when all members have been asked for.
  void refuse_unknown() const {
    for (const auto& [name, value] : json_.items())
      if (std::find(known_.begin(), known_.end(), name) == known_.end())
        fail(path_, fmt::format("unknown member '{}'; known: {}", name, fmt::join(known_, ", ")));
  }

 private:
  Json::const_iterator known(const char* name) {
    known_.emplace_back(name);
    return json_.find(name);
  }
  const Json& present(const char* name) {
    const auto found = known(name);
    if (found == json_.end()) fail(path_, fmt::format("the member '{}' is missing", name));
    return *found;
  }

  const Json& json_;
  const std::string& path_;
  std::vector<std::string_view> known_;
};

template <class Object>
requires std::is_class_v<Object>
void read(const Json& json, const std::string& path, Object& object) {
  Reader reader(json, path);
  members(object, reader);
  reader.refuse_unknown();
}

/// What a file says it is, before anything else in it is believed.
struct Header {
  std::string name;
  std::uint64_t version = 0;
};

template <Some<Header> T, class Visitor>
void members(T& header, Visitor& visitor) {
  visitor.required("name", header.name);
  visitor.required("version", header.version);
}

void check_header(const Json& json) {
  if (!json.is_object() || !json.contains("schema")) fail("", "this is no report: it has no member 'schema'");
  const auto header = read_as<Header>(json["schema"], "schema");
  if (header.name != kSchemaName)
    fail("schema.name", fmt::format("expected {}, found {}", kSchemaName, header.name));
  if (header.version != kSchemaVersion)
    fail("schema.version",
         fmt::format("version {} is not read, only version {}", header.version, kSchemaVersion));
}

/// JSON leaves the meaning of a repeated member open, so it has none here.
Json parse(const std::string& text) try {
  std::vector<std::set<std::string>> open_objects;
  return Json::parse(text, [&](int, Json::parse_event_t event, Json& parsed) {
    if (event == Json::parse_event_t::object_start) open_objects.emplace_back();
    if (event == Json::parse_event_t::object_end) open_objects.pop_back();
    if (event == Json::parse_event_t::key && !open_objects.back().insert(parsed.get<std::string>()).second)
      fail("", fmt::format("the member {} is there twice", parsed.dump()));
    return true;
  });
} catch (const Json::exception& error) {
  const std::string what = error.what();  // "[json.exception.<kind>] <message>"
  fail("", "this is not JSON: " + what.substr(what.find("] ") + 2));
}

template <class Listed>
std::set<std::string> ids(const std::vector<Listed>& list) {
  std::set<std::string> result;
  for (const Listed& one : list) result.insert(one.id);
  return result;
}

/// A map has a sum for every tile.
void check_map(const WorkMap& map, const std::string& path) {
  if (map.resolution < 1 || map.resolution > kMostMapRows)
    fail(path + ".resolution", fmt::format("expected 1 to {}, found {}", kMostMapRows, map.resolution));
  if (map.tile < 1 || map.tile > map.resolution)
    fail(path + ".tile", fmt::format("expected 1 to {}, the resolution, found {}", map.resolution, map.tile));
  const std::uint64_t tiles = map.columns() * map.columns();
  for (const auto& [name, sums] :
       {std::pair(".object_tests", &map.object_tests), std::pair(".volume_tests", &map.volume_tests)})
    if (sums->size() != tiles)
      fail(path + name, fmt::format("expected {} numbers, one a tile, found {}", tiles, sums->size()));
}

void check_measurements(const Report& report) {
  const auto scenes = ids(report.scenes), ray_sets = ids(report.ray_sets);
  for (std::size_t i = 0; i < report.measurements.size(); ++i) {
    const Measurement& measurement = report.measurements[i];
    const std::string path = element_path("measurements", i);
    if (!scenes.contains(measurement.scene))
      fail(path + ".scene", fmt::format("no scene '{}' in scenes", measurement.scene));
    if (!ray_sets.contains(measurement.rays))
      fail(path + ".rays", fmt::format("no ray set '{}' in ray_sets", measurement.rays));
    if (measurement.verdict.status == Status::wrong && !measurement.trace_ns.empty())
      fail(path + ".trace_ns", "a wrong answer has no time");
    if (measurement.work_map) check_map(*measurement.work_map, path + ".work_map");
  }
}

}  // namespace

Report from_json(const std::string& text) {
  Json json = parse(text);
  check_header(json);
  json.erase("schema");
  const auto report = read_as<Report>(json, "");
  check_measurements(report);
  return report;
}

Report read_report(const std::string& path) {
  std::error_code ignored;
  std::ifstream file(path, std::ios::binary);
  if (!file || std::filesystem::is_directory(path, ignored))
    throw ReportError(fmt::format("{}: cannot be opened as a file", path));
  const std::string text(std::istreambuf_iterator<char>(file), {});
  try {
    return from_json(text);
  } catch (const ReportError& error) {
    throw ReportError(fmt::format("{}: {}", path, error.what()));
  }
}

}  // namespace rayshoot::report
