#include "scenes/core/spec.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <charconv>
#include <numeric>

namespace rayshoot {

namespace {

std::string trimmed(std::string_view text) {
  const auto first = text.find_first_not_of(" \t");
  if (first == std::string_view::npos) return {};
  return std::string(text.substr(first, text.find_last_not_of(" \t") - first + 1));
}

template <class Number>
bool parse_number(const std::string& text, Number& number) {
  const char* end = text.data() + text.size();
  const auto [stop, error] = std::from_chars(text.data(), end, number);
  return error == std::errc{} && stop == end;
}

/// Levenshtein's distance, to suggest the nearest known name.
std::size_t edit_distance(const std::string& a, const std::string& b) {
  std::vector<std::size_t> row(b.size() + 1);
  std::iota(row.begin(), row.end(), std::size_t{0});
  for (std::size_t i = 1; i <= a.size(); ++i) {
    std::size_t diagonal = row[0]++;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const std::size_t substituted = diagonal + (a[i - 1] != b[j - 1]);
      diagonal = row[j];
      row[j] = std::min({row[j] + 1, row[j - 1] + 1, substituted});
    }
  }
  return row.back();
}

Arguments::Value parse_value(const Parameter& parameter, const std::string& text, const std::string& owner) {
  const auto refuse = [&]() {
    return InputError(fmt::format("{}: {}={} is not accepted; {} takes {}", owner, parameter.name, text,
                                  parameter.name, parameter.range()));
  };
  const auto within = [&](double number) {
    return number >= parameter.minimum && number <= parameter.maximum;
  };
  switch (parameter.type) {
    case Parameter::Type::integer: {
      long long number = 0;
      if (!parse_number(text, number) || !within(static_cast<double>(number))) throw refuse();
      return number;
    }
    case Parameter::Type::real: {
      double number = 0;
      if (!parse_number(text, number) || !within(number)) throw refuse();
      return number;
    }
    case Parameter::Type::boolean:
      if (text == "on" || text == "true") return true;
      if (text == "off" || text == "false") return false;
      throw refuse();
    case Parameter::Type::choice:
      if (std::find(parameter.choices.begin(), parameter.choices.end(), text) == parameter.choices.end())
        throw refuse();
      return text;
    case Parameter::Type::text:
      return text;
  }
  throw refuse();
}

}  // namespace

std::string Parameter::range() const {
  switch (type) {
    case Type::integer:
    case Type::real:
      return fmt::format("{:g} to {:g}", minimum, maximum);
    case Type::boolean:
      return "on|off";
    case Type::choice:
      return fmt::format("{}", fmt::join(choices, "|"));
    case Type::text:
      return "text";
  }
  return {};
}

Parameter integer_parameter(std::string name, long long default_value, double minimum, double maximum,
                            std::string description) {
  return {std::move(name),
          Parameter::Type::integer,
          std::to_string(default_value),
          std::move(description),
          minimum,
          maximum,
          {}};
}

Parameter real_parameter(std::string name, double default_value, double minimum, double maximum,
                         std::string description) {
  return {std::move(name),
          Parameter::Type::real,
          fmt::format("{}", default_value),
          std::move(description),
          minimum,
          maximum,
          {}};
}

Parameter boolean_parameter(std::string name, bool default_value, std::string description) {
  return {std::move(name),
          Parameter::Type::boolean,
          default_value ? "on" : "off",
          std::move(description),
          0,
          0,
          {}};
}

Parameter choice_parameter(std::string name, std::string default_value, std::vector<std::string> choices,
                           std::string description) {
  return {std::move(name),   Parameter::Type::choice, std::move(default_value), std::move(description), 0, 0,
          std::move(choices)};
}

Parameter text_parameter(std::string name, std::string default_value, std::string description) {
  return {std::move(name), Parameter::Type::text, std::move(default_value), std::move(description), 0, 0, {}};
}

Spec parse_spec(std::string_view text) {
  const auto refuse = [&](const std::string& why) {
    return InputError(fmt::format(
        "'{}' is not a specification ({}); write name, name:size, name(key=value,...) or name:size/form",
        text, why));
  };
  Spec spec;
  std::string rest(text);

  // Take out the arguments in parentheses, which stand behind the name or behind the form.
  const auto open = rest.find('(');
  if (open != std::string::npos) {
    const auto close = rest.rfind(')');
    if (close == std::string::npos || close < open) throw refuse("the parenthesis is not closed");
    const std::string arguments = rest.substr(open + 1, close - open - 1);
    const std::string behind = trimmed(std::string_view(rest).substr(close + 1));
    if (!behind.empty() && behind[0] != '/') throw refuse(fmt::format("'{}' behind the parenthesis", behind));
    rest = rest.substr(0, open) + behind;
    std::string_view list = arguments;
    while (!list.empty()) {
      const auto comma = list.find(',');
      const std::string_view item = list.substr(0, comma);
      const auto equals = item.find('=');
      if (equals == std::string_view::npos) throw refuse(fmt::format("'{}' is not key=value", item));
      const std::string key = trimmed(item.substr(0, equals));
      if (!spec.arguments.emplace(key, trimmed(item.substr(equals + 1))).second)
        throw refuse(fmt::format("'{}' is given twice", key));
      list = comma == std::string_view::npos ? std::string_view{} : list.substr(comma + 1);
    }
  }

  // Split off the form behind the last slash.
  const auto slash = rest.rfind('/');
  if (slash != std::string::npos) {
    spec.form = trimmed(std::string_view(rest).substr(slash + 1));
    if (spec.form.empty()) throw refuse("nothing behind the slash");
    rest = rest.substr(0, slash);
  }

  // What is left is a name with an optional size.
  const auto colon = rest.find(':');
  spec.name = trimmed(std::string_view(rest).substr(0, colon));
  if (colon != std::string::npos) {
    spec.size = trimmed(std::string_view(rest).substr(colon + 1));
    if (spec.size.empty()) throw refuse("nothing behind the colon");
  }
  if (spec.name.empty()) throw refuse("the name is empty");
  return spec;
}

Arguments::Arguments(const std::vector<Parameter>& parameters,
                     const std::map<std::string, std::string>& given, const std::string& owner) {
  std::vector<std::string> names;
  for (const Parameter& parameter : parameters) {
    names.push_back(parameter.name);
    const auto found = given.find(parameter.name);
    const std::string& text = found == given.end() ? parameter.default_value : found->second;
    values_.emplace(parameter.name, parse_value(parameter, text, owner));
  }
  for (const auto& [name, value] : given)
    if (!values_.contains(name)) throw InputError(owner + ": " + unknown_name("parameter", name, names));
}

long long Arguments::integer(const std::string& name) const { return std::get<long long>(values_.at(name)); }
double Arguments::real(const std::string& name) const { return std::get<double>(values_.at(name)); }
bool Arguments::boolean(const std::string& name) const { return std::get<bool>(values_.at(name)); }
const std::string& Arguments::text(const std::string& name) const {
  return std::get<std::string>(values_.at(name));
}

std::string text_of(const Arguments::Value& value) {
  if (const bool* flag = std::get_if<bool>(&value)) return *flag ? "on" : "off";
  return std::visit([](const auto& v) { return fmt::format("{}", v); }, value);
}

std::string unknown_name(const std::string& what, const std::string& name,
                         const std::vector<std::string>& known) {
  const auto nearest = std::min_element(known.begin(), known.end(), [&](const auto& a, const auto& b) {
    return edit_distance(name, a) < edit_distance(name, b);
  });
  const bool near = nearest != known.end() && edit_distance(name, *nearest) <= 1 + name.size() / 3;
  const std::string hint = near ? fmt::format("did you mean '{}'? ", *nearest) : "";
  return fmt::format("unknown {} '{}'; {}known: {}", what, name, hint,
                     known.empty() ? "none" : fmt::format("{}", fmt::join(known, ", ")));
}

void require_known(const std::string& what, const std::vector<std::string>& names,
                   const std::vector<std::string>& known) {
  for (const std::string& name : names)
    if (std::find(known.begin(), known.end(), name) == known.end())
      throw InputError(unknown_name(what, name, known));
}

}  // namespace rayshoot
