#pragma once

#include <string>

namespace rayshoot::analysis {

/// A text of one paragraph in which nothing is a command, in ASCII and letters with accents: what fonts of LaTeX have
/// under another name is named, other characters are shown by their numbers, "U+4E2D".
std::string latex_text(const std::string& text);

/// The same, which may be broken after punctuation inside words.
std::string breakable_latex_text(const std::string& text);

}  // namespace rayshoot::analysis
