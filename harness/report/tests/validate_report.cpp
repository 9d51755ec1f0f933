// validate_report SCHEMA REPORT: exit status 0 when the report is valid, 1 when it is not, 2 when that cannot be told.

#include <cstdio>

#include "schema_validation.h"

int main(int argument_count, char** arguments) try {
  if (argument_count != 3) throw std::runtime_error("usage: validate_report SCHEMA REPORT");
  const nlohmann::json schema = rayshoot::test::load_json(arguments[1]);
  if (!schema.is_object() || !schema.contains("$schema"))
    throw std::runtime_error(fmt::format("{}: is not a JSON Schema", arguments[1]));
  const std::string found = rayshoot::test::violation(schema, rayshoot::test::load_json(arguments[2]));
  if (found.empty()) return 0;
  fmt::print(stderr, "{}: {}\n", arguments[2], found);
  return 1;
} catch (const std::exception& error) {
  fmt::print(stderr, "{}\n", error.what());
  return 2;
}
