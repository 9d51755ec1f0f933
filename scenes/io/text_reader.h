#pragma once

#include <istream>
#include <string>
#include <string_view>
#include <vector>

#include "scenes/geometry/vec.h"

namespace rayshoot {

/// A word of a file as a message may show it: short, and printable whatever the file holds.
std::string shown(std::string_view word);

/// The words and numbers of a text, line by line, in memory that does not grow with the text. Words are
/// separated by blanks; `#` begins a comment. Every error is an InputError "name:line: reason".
class TextReader {
 public:
  /// `name` stands for the text in messages; `in` must outlive the reader.
  TextReader(std::istream& in, std::string name);

  /// Go to the next line that holds a word; false at the end of the text.
  bool next_line();
  /// Whether the current line holds no further word.
  bool line_is_done();
  /// The next word of the line, empty where there is none; valid until the next line.
  std::string_view word();
  /// The next word, which must be a finite number; `what` names it in messages.
  double number(std::string_view what);
  /// The next three words, which must be finite numbers.
  Vec3d point(std::string_view what);
  /// The next word, which must be an integer of at least `minimum`.
  int integer(std::string_view what, int minimum);
  /// Refuse a line that goes on.
  void end_line();
  /// Refuse the text because of its current line.
  [[noreturn]] void fail(const std::string& reason) const;

 private:
  bool next_raw_line();
  bool read_block();

  std::istream& in_;
  std::string name_;
  std::size_t line_number_ = 0;
  std::vector<char> block_;
  /// The unread part of the block, and the unread part of the current line.
  std::size_t begin_ = 0, end_ = 0;
  std::string_view line_;
};

}  // namespace rayshoot
