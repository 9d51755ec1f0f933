#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "harness/report/members.h"

namespace rayshoot::report {

namespace {

using Json = nlohmann::ordered_json;

/// Thrown by a number that has no JSON, and caught by the nearest member that may be absent.
struct NotFinite {};

Json json_of(const std::string& text) { return text; }
Json json_of(Status status) { return kStatusNames[static_cast<std::size_t>(status)]; }

template <class Number>
requires std::is_arithmetic_v<Number> Json json_of(Number number) {
  if constexpr (std::is_floating_point_v<Number>)
    if (!std::isfinite(number)) throw NotFinite();
  return number;
}

Json json_of(const ConfigValue& value) {
  return std::visit([](const auto& v) { return json_of(v); }, value);
}

template <class Object>
requires std::is_class_v<Object> Json json_of(const Object& object);

template <std::size_t N>
Json json_of(const std::array<double, N>& numbers) {
  Json list = Json::array();
  for (const double number : numbers) list.push_back(json_of(number));
  return list;
}

template <class Element>
Json json_of(const std::vector<Element>& elements) {
  Json list = Json::array();
  for (const Element& element : elements) list.push_back(json_of(element));
  return list;
}

/// The entries of a map are optional each.
template <class Value>
Json json_of(const std::map<std::string, Value>& map) {
  Json object = Json::object();
  for (const auto& [key, value] : map) try {
      object[key] = json_of(value);
    } catch (const NotFinite&) {
      continue;
    }
  return object;
}

class Writer {
 public:
  template <class T>
  void required(const char* name, const T& value) {
    object[name] = json_of(value);
  }
  template <class Names>
  void choice(const char* name, const std::string& value, const Names&) {
    required(name, value);
  }
  template <class Names>
  void optional_choice(const char* name, const std::string& value, const Names& names) {
    if (value != names.front()) required(name, value);
  }
  template <class T>
  void optional(const char* name, const std::optional<T>& value) {
    if (value) unless_not_finite(name, *value);
  }
  template <class T>
  void optional(const char* name, const std::vector<T>& values) {
    if (!values.empty()) unless_not_finite(name, values);
  }
  template <class T>
  void optional(const char* name, const std::map<std::string, T>& values) {
    if (!values.empty()) required(name, values);
  }

  Json object = Json::object();

 private:
  template <class T>
  void unless_not_finite(const char* name, const T& value) try {
    required(name, value);
  } catch (const NotFinite&) {
  }
};

template <class Object>
requires std::is_class_v<Object> Json json_of(const Object& object) {
  Writer writer;
  members(object, writer);
  return std::move(writer.object);
}

[[noreturn]] void cannot_write(const std::string& path, const std::string& reason) {
  throw ReportError(fmt::format("cannot write {}: {}", path, reason));
}

std::string last_error() { return errno ? std::strerror(errno) : "writing failed"; }

}  // namespace

std::string to_json(const Report& report) try {
  Json json{{"schema", {{"name", kSchemaName}, {"version", kSchemaVersion}}}};
  json.update(json_of(report));
  // A name of a file may hold bytes that are not UTF-8; JSON cannot.
  return json.dump(1, ' ', false, Json::error_handler_t::replace) + '\n';
} catch (const NotFinite&) {
  throw ReportError("run.seconds, which a report must have, is not a finite number");
}

void write_report(const Report& report, const std::string& path) {
  const std::string text = to_json(report);
  const std::string temporary = fmt::format("{}.{}.part", path, ::getpid());
  errno = 0;
  std::ofstream file(temporary, std::ios::binary | std::ios::trunc);
  file << text;
  file.close();
  std::error_code error;
  if (file) std::filesystem::rename(temporary, path, error);
  if (file && !error) return;
  const std::string reason = error ? error.message() : last_error();
  std::filesystem::remove(temporary, error);
  cannot_write(path, reason);
}

}  // namespace rayshoot::report
