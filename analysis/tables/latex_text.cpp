#include "analysis/tables/latex_text.h"

#include <fmt/format.h>

#include <map>
#include <string_view>

namespace rayshoot::analysis {

namespace {

const std::map<char32_t, const char*>& commands() {
  static const std::map<char32_t, const char*> names{{U'\\', "\\textbackslash{}"},
                                                     {U'~', "\\textasciitilde{}"},
                                                     {U'^', "\\textasciicircum{}"},
                                                     {U'<', "\\textless{}"},
                                                     {U'>', "\\textgreater{}"},
                                                     {U'|', "\\textbar{}"},
                                                     {U'&', "\\&"},
                                                     {U'%', "\\%"},
                                                     {U'$', "\\$"},
                                                     {U'#', "\\#"},
                                                     {U'_', "\\_"},
                                                     {U'{', "\\{"},
                                                     {U'}', "\\}"},
                                                     {U'[', "{[}"},
                                                     {U']', "{]}"},
                                                     {U'\u00A0', "~"},
                                                     {U'§', "\\S{}"},
                                                     {U'±', "$\\pm$"},
                                                     {U'²', "$^2$"},
                                                     {U'³', "$^3$"},
                                                     {U'¹', "$^1$"},
                                                     {U'⁰', "$^0$"},
                                                     {U'⁴', "$^4$"},
                                                     {U'⁵', "$^5$"},
                                                     {U'⁶', "$^6$"},
                                                     {U'⁷', "$^7$"},
                                                     {U'⁸', "$^8$"},
                                                     {U'⁹', "$^9$"},
                                                     {U'⁻', "$^-$"},
                                                     {U'µ', "$\\mu$"},
                                                     {U'·', "$\\cdot$"},
                                                     {U'×', "$\\times$"},
                                                     {U'«', "$\\ll$"},
                                                     {U'»', "$\\gg$"},
                                                     {U'°', "$^\\circ$"},
                                                     {U'–', "--"},
                                                     {U'—', "---"},
                                                     {U'…', "\\ldots{}"},
                                                     {U'−', "$-$"},
                                                     {U'→', "$\\to$"},
                                                     {U'≤', "$\\leq$"},
                                                     {U'≥', "$\\geq$"},
                                                     {U'≈', "$\\approx$"},
                                                     {U'∞', "$\\infty$"},
                                                     {U'√', "$\\surd$"},
                                                     {U'α', "$\\alpha$"},
                                                     {U'β', "$\\beta$"},
                                                     {U'ε', "$\\varepsilon$"},
                                                     {U'κ', "$\\kappa$"},
                                                     {U'λ', "$\\lambda$"},
                                                     {U'μ', "$\\mu$"},
                                                     {U'π', "$\\pi$"},
                                                     {U'σ', "$\\sigma$"},
                                                     {U'Δ', "$\\Delta$"}};
  return names;
}

/// What every font of LaTeX can set: ASCII, and Latin letters with the accents of western languages.
bool is_plain(char32_t c) {
  return (c >= 0x20 && c < 0x7F) ||
         (c >= 0xC0 && c <= 0xFF && std::u32string_view(U"ÐÞðþ÷").find(c) == std::u32string_view::npos);
}

/// The character of UTF-8 that begins at `at`, which is moved behind it.
char32_t next(const std::string& text, std::size_t& at) {
  const auto first = static_cast<unsigned char>(text[at++]);
  if (first < 0xC0) return first;
  char32_t c = first & (first < 0xE0 ? 0x1F : first < 0xF0 ? 0x0F : 0x07);
  for (; at < text.size() && (static_cast<unsigned char>(text[at]) & 0xC0) == 0x80; ++at)
    c = c << 6 | (static_cast<unsigned char>(text[at]) & 0x3F);
  return c;
}

std::string set(const std::string& text, std::string_view break_after) {
  std::string result;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t begin = at;
    const char32_t c = next(text, at);
    const auto command = commands().find(c);
    if (command != commands().end())
      result += command->second;
    else if (c < 0x20 || c == 0x7F)
      result += ' ';
    else if (c == U'-' && result.ends_with('-'))
      result += "{}-";  // two hyphens would become a dash
    else
      result += is_plain(c) ? text.substr(begin, at - begin)
                            : fmt::format("U+{:04X}", static_cast<std::uint32_t>(c));
    if (c < 0x80 && break_after.find(static_cast<char>(c)) != std::string_view::npos)
      result += "\\allowbreak{}";
  }
  return result;
}

}  // namespace

std::string latex_text(const std::string& text) { return set(text, ""); }
std::string breakable_latex_text(const std::string& text) { return set(text, "_/|="); }

}  // namespace rayshoot::analysis
