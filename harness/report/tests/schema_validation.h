#pragma once

#include <fmt/format.h>

#include <fstream>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string>
#include <valijson/adapters/nlohmann_json_adapter.hpp>
#include <valijson/schema.hpp>
#include <valijson/schema_parser.hpp>
#include <valijson/validation_results.hpp>
#include <valijson/validator.hpp>

namespace rayshoot::test {

/// The JSON in a file; throws std::runtime_error, with one line that names the file, where there is none.
inline nlohmann::json load_json(const std::string& path) try {
  std::ifstream file(path);
  if (!file) throw std::runtime_error(fmt::format("{}: cannot be opened", path));
  return nlohmann::json::parse(file);
} catch (const nlohmann::json::exception& error) {
  throw std::runtime_error(fmt::format("{}: {}", path, error.what()));
}

/// The innermost place where `document` violates `schema`, and how; empty when it is valid. Throws
/// std::exception when `schema` is not a JSON Schema.
inline std::string violation(const nlohmann::json& schema, const nlohmann::json& document) {
  using Adapter = valijson::adapters::NlohmannJsonAdapter;
  valijson::Schema rules;
  valijson::SchemaParser(valijson::SchemaParser::kDraft7).populateSchema(Adapter(schema), rules);
  valijson::ValidationResults results;
  if (valijson::Validator().validate(rules, Adapter(document), &results)) return {};
  valijson::ValidationResults::Error error, innermost;
  while (results.popError(error))
    if (error.context.size() > innermost.context.size()) innermost = error;
  std::string place;
  for (const std::string& step : innermost.context) place += step;
  return fmt::format("{}: {}", place, innermost.description);
}

}  // namespace rayshoot::test
