#pragma once

#include <map>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "accel/core/engine.h"

namespace rayshoot {

/// An expression of the algebra of optimizers (Revelles & Ureña §5):
///   technique, technique(key=value,...)          a technique of the registry
///   A | B, sequential(A, B, key=value,...)       sequential composition; binds tighter than ||
///   A || B                                       parallel composition
///   recursive(B, key=value,...)                  A = B|A
/// Operators of a kind group from left to right; parentheses group otherwise.
struct Expression {
  enum class Kind { technique, sequential, parallel, recursive };

  Kind kind = Kind::technique;
  /// Of a technique; it stays the registry's.
  const TechniqueEntry* entry = nullptr;
  /// What is composed.
  std::vector<Expression> parts{};
  /// As written, and with defaults.
  std::map<std::string, std::string> given{};
  Arguments arguments{};

  /// In the shortest form that means the same.
  std::string text() const;
  /// Whether it is based on spatial indexing, as the first part of a sequential composition must be.
  bool indexes_space() const;
  /// Techniques one below the other.
  std::size_t levels() const;
  /// Of its own, not of its parts.
  std::vector<Parameter> parameters() const;
};

/// Throws InputError, with the text and a caret under the column where it stops making sense.
Expression parse_expression(std::string_view text, std::span<const TechniqueEntry* const> known);

/// Whether a text is more than the name of a technique with arguments.
bool is_composition(std::string_view text);

/// The values of all parameters of its parts, each named by the part's place in the expression: "2.density".
Arguments configuration(const Expression& expression);

/// The expression as an entry like those of the registry.
TechniqueEntry compose(const Expression& expression);

}  // namespace rayshoot
