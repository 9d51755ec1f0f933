#pragma once

#include <map>
#include <stdexcept>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace rayshoot {

/// Bad usage or bad input; `what()` is one line that says what would have been right.
class InputError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// One parameter of a scene, a ray distribution or a technique, as listed and as checked.
struct Parameter {
  enum class Type { integer, real, boolean, choice, text };

  std::string name;
  Type type;
  std::string default_value;
  std::string description;
  /// Bounds of a number, both included.
  double minimum = 0, maximum = 0;
  /// The accepted words of a choice.
  std::vector<std::string> choices;

  /// The accepted values in words, for example "1 to 64" or "box|exact".
  std::string range() const;
};

Parameter integer_parameter(std::string name, long long default_value, double minimum, double maximum,
                            std::string description);
Parameter real_parameter(std::string name, double default_value, double minimum, double maximum,
                         std::string description);
Parameter boolean_parameter(std::string name, bool default_value, std::string description);
Parameter choice_parameter(std::string name, std::string default_value, std::vector<std::string> choices,
                           std::string description);
/// Free text, checked by whoever reads it.
Parameter text_parameter(std::string name, std::string default_value, std::string description);

/// A specification `name`, `name:size`, `name(key=value,…)`, each with an optional `/form` behind it;
/// arguments may also stand behind the form.
struct Spec {
  std::string name;
  std::string size;
  std::string form;
  std::map<std::string, std::string> arguments;
};

/// Throws InputError when the text is not a specification.
Spec parse_spec(std::string_view text);

/// Values for all parameters of something: those given, checked, and defaults for the others.
class Arguments {
 public:
  Arguments() = default;
  /// Throws InputError on an unknown name or a value out of range; `owner` is named in the message.
  Arguments(const std::vector<Parameter>& parameters, const std::map<std::string, std::string>& given,
            const std::string& owner);

  long long integer(const std::string& name) const;
  double real(const std::string& name) const;
  bool boolean(const std::string& name) const;
  const std::string& text(const std::string& name) const;

  using Value = std::variant<bool, long long, double, std::string>;
  const std::map<std::string, Value>& values() const { return values_; }

 private:
  std::map<std::string, Value> values_;
};

/// A value as a specification writes it.
std::string text_of(const Arguments::Value& value);

/// "unknown WHAT 'name'; known: a, b, c", the nearest by spelling first in a "did you mean" where one is
/// near.
std::string unknown_name(const std::string& what, const std::string& name,
                         const std::vector<std::string>& known);

/// Throws InputError with that message on the first of the names that is not known.
void require_known(const std::string& what, const std::vector<std::string>& names,
                   const std::vector<std::string>& known);

}  // namespace rayshoot
