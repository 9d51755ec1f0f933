#include "accel/algebra/expression.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>

#include "accel/algebra/recursive.h"

namespace rayshoot {

namespace {

using Kind = Expression::Kind;

struct Composition {
  const char* name;
  Kind kind;
  std::size_t parts;
};
constexpr Composition kCompositions[] = {
    {"sequential", Kind::sequential, 2}, {"parallel", Kind::parallel, 2}, {"recursive", Kind::recursive, 1}};

const Composition* find_composition(std::string_view name) {
  const auto found = std::find_if(std::begin(kCompositions), std::end(kCompositions),
                                  [&](const Composition& composition) { return composition.name == name; });
  return found == std::end(kCompositions) ? nullptr : found;
}

std::vector<Parameter> parameters_of(const Expression& expression) {
  switch (expression.kind) {
    case Kind::technique:
      return expression.entry->info.parameters;
    case Kind::sequential:
      return sequential_parameters();
    case Kind::parallel:
      return {};
    case Kind::recursive:
      return recursive_parameters();
  }
  return {};
}

/// Recursive descent, one function a rule of the grammar.
class Parser {
 public:
  Parser(std::string_view text, std::span<const TechniqueEntry* const> known) : text_(text), known_(known) {}

  Expression parse() {
    Expression whole = expression();
    if (peek() != '\0') fail(at_, "an operator | or || or the end is expected");
    return whole;
  }

 private:
  [[noreturn]] void fail(std::size_t column, const std::string& what) const {
    throw InputError(fmt::format("column {}: {}\n  {}\n  {:>{}}", column + 1, what, text_, '^', column + 1));
  }

  char peek() {
    while (at_ < text_.size() && (text_[at_] == ' ' || text_[at_] == '\t')) ++at_;
    return at_ < text_.size() ? text_[at_] : '\0';
  }
  bool take(std::string_view token) {
    peek();
    if (text_.substr(at_, token.size()) != token) return false;
    at_ += token.size();
    return true;
  }
  bool at_sequential() { return peek() == '|' && text_.substr(at_, 2) != "||"; }
  void expect(char token, const char* what) {
    if (peek() != token) fail(at_, fmt::format("{} is expected", what));
    ++at_;
  }

  /// sequence { "||" sequence }
  Expression expression() {
    Expression left = sequence();
    while (take("||")) {
      Expression right = sequence();
      left = composition(Kind::parallel, {std::move(left), std::move(right)});
    }
    return left;
  }

  /// term { "|" term }
  Expression sequence() {
    peek();
    std::size_t begin = at_;
    Expression left = term();
    while (at_sequential()) {
      require_index(left, begin);
      ++at_;
      Expression right = term();
      left = composition(Kind::sequential, {std::move(left), std::move(right)});
    }
    return left;
  }

  /// "(" expression ")", or a name with or without arguments
  Expression term() {
    if (depth_ == kMostDepth) fail(at_, fmt::format("more than {} parentheses in one another", kMostDepth));
    ++depth_;
    Expression result = take("(") ? parenthesis() : named();
    --depth_;
    return result;
  }
  Expression parenthesis() {
    Expression inside = expression();
    expect(')', "a closing parenthesis");
    return inside;
  }

  Expression named() {
    peek();
    const std::size_t begin = at_;
    const std::string name = word();
    if (name.empty()) fail(begin, "a technique is expected");
    if (const Composition* composition = find_composition(name)) return call(*composition);
    Expression result{.kind = Kind::technique, .entry = find(name, begin)};
    if (!result.entry->composable()) fail(begin, name + " hands out no candidates, so it cannot be composed");
    if (take("(")) arguments(result, name);
    result.arguments = Arguments(result.entry->info.parameters, result.given, name);
    return result;
  }

  /// name "(" expression { "," expression } { "," key "=" value } ")"
  Expression call(const Composition& kind) {
    expect('(', "an opening parenthesis");
    Expression result{.kind = kind.kind};
    for (std::size_t part = 0; part < kind.parts; ++part) {
      if (part > 0) expect(',', "a comma and the next part");
      peek();
      const std::size_t begin = at_;
      result.parts.push_back(expression());
      if (part == 0 && kind.kind != Kind::parallel) require_index(result.parts[0], begin);
    }
    if (peek() == ',')
      ++at_, arguments(result, kind.name);
    else
      expect(')', "a comma or a closing parenthesis");
    result.arguments = Arguments(parameters_of(result), result.given, kind.name);
    return result;
  }

  /// key "=" value { "," key "=" value } ")", or ")" alone
  void arguments(Expression& result, const std::string& owner) {
    if (take(")")) return;
    do {
      peek();
      const std::size_t begin = at_;
      const std::string key = word();
      if (key.empty()) fail(at_, "key=value is expected");
      expect('=', "an equals sign");
      const std::string value = this->value();
      if (result.given.contains(key)) fail(begin, fmt::format("'{}' is given twice", key));
      try {
        Arguments(parameters_of(result), {{key, value}}, owner);
      } catch (const InputError& error) {
        fail(begin, error.what());
      }
      result.given.emplace(key, value);
    } while (take(","));
    expect(')', "a comma or a closing parenthesis");
  }

  std::string word() {
    const std::size_t begin = at_;
    while (at_ < text_.size() && (std::isalnum(static_cast<unsigned char>(text_[at_])) || text_[at_] == '_'))
      ++at_;
    return std::string(text_.substr(begin, at_ - begin));
  }
  std::string value() {
    peek();
    const std::size_t begin = at_;
    at_ = std::min(text_.find_first_of(",)", at_), text_.size());
    std::size_t end = at_;
    while (end > begin && text_[end - 1] == ' ') --end;
    return std::string(text_.substr(begin, end - begin));
  }

  const TechniqueEntry* find(const std::string& name, std::size_t column) const {
    std::vector<std::string> names;
    for (const TechniqueEntry* entry : known_) {
      if (entry->info.id == name) return entry;
      names.push_back(entry->info.id);
    }
    for (const Composition& composition : kCompositions) names.push_back(composition.name);
    fail(column, unknown_name("technique", name, names));
  }

  void require_index(const Expression& first, std::size_t column) const {
    if (!first.indexes_space())
      fail(column, first.text() + " is not based on spatial indexing, so it has no voxels to divide");
  }

  static Expression composition(Kind kind, std::vector<Expression> parts) {
    Expression result{.kind = kind, .parts = std::move(parts)};
    result.arguments = Arguments(parameters_of(result), {}, "");
    return result;
  }

  static constexpr int kMostDepth = 64;

  std::string_view text_;
  std::span<const TechniqueEntry* const> known_;
  std::size_t at_ = 0;
  int depth_ = 0;
};

std::string call_text(const std::string& name, const Expression& expression) {
  std::string inside;
  const auto add = [&](const std::string& item) {
    inside += fmt::format("{}{}", inside.empty() ? "" : ",", item);
  };
  for (const Expression& part : expression.parts) add(part.text());
  for (const auto& [key, value] : expression.given) add(fmt::format("{}={}", key, value));
  return inside.empty() ? name : fmt::format("{}({})", name, inside);
}

/// A part of an operator that binds as tightly as `binding`: 2 of |, 1 of ||.
std::string operand_text(const Expression& part, int binding, bool right) {
  const bool plain = part.given.empty();
  const int own = part.kind == Kind::sequential && plain ? 2 : part.kind == Kind::parallel && plain ? 1 : 3;
  return own < binding || (own == binding && right) ? fmt::format("({})", part.text()) : part.text();
}

}  // namespace

std::string Expression::text() const {
  const auto infix = [&](const char* sign, int binding) {
    return operand_text(parts[0], binding, false) + sign + operand_text(parts[1], binding, true);
  };
  switch (kind) {
    case Kind::technique:
      return call_text(entry->info.id, *this);
    case Kind::sequential:
      return given.empty() ? infix("|", 2) : call_text("sequential", *this);
    case Kind::parallel:
      return infix("||", 1);
    case Kind::recursive:
      return call_text("recursive", *this);
  }
  return {};
}

bool Expression::indexes_space() const {
  if (kind == Kind::technique) return entry->indexes_space;
  return kind != Kind::parallel &&
         std::all_of(parts.begin(), parts.end(), [](const Expression& part) { return part.indexes_space(); });
}

std::size_t Expression::levels() const {
  std::size_t levels = kind == Kind::technique ? 1 : 0;
  for (const Expression& part : parts) levels += part.levels();
  return kind == Kind::recursive ? 1 + levels * static_cast<std::size_t>(arguments.integer("max_depth"))
                                 : levels;
}

std::vector<Parameter> Expression::parameters() const { return parameters_of(*this); }

Expression parse_expression(std::string_view text, std::span<const TechniqueEntry* const> known) {
  return Parser(text, known).parse();
}

bool is_composition(std::string_view text) {
  const std::size_t begin = std::min(text.find_first_not_of(" \t"), text.size());
  const std::string_view name = text.substr(begin, text.find_first_of(" \t(", begin) - begin);
  return text.find('|') != std::string_view::npos || text.substr(begin, 1) == "(" || find_composition(name);
}

}  // namespace rayshoot
