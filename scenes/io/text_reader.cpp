#include "scenes/io/text_reader.h"

#include <fmt/format.h>

#include <charconv>
#include <cstring>

#include "scenes/core/spec.h"

namespace rayshoot {

namespace {

constexpr std::size_t kBlockBytes = 1 << 18;
constexpr std::size_t kShownCharacters = 40;

bool is_blank(char c) { return c == ' ' || c == '\t' || c == '\r' || c == '\v' || c == '\f'; }

}  // namespace

std::string shown(std::string_view word) {
  std::string text(word.substr(0, kShownCharacters));
  for (char& c : text)
    if (c < ' ' || c > '~') c = '?';
  return word.size() > kShownCharacters ? text + "..." : text;
}

TextReader::TextReader(std::istream& in, std::string name)
    : in_(in), name_(std::move(name)), block_(kBlockBytes) {}

void TextReader::fail(const std::string& reason) const {
  throw InputError(fmt::format("{}:{}: {}", name_, line_number_, reason));
}

/// Move what is unread to the front of the block and fill it up; false when nothing more came.
bool TextReader::read_block() {
  if (begin_ == 0 && end_ == block_.size()) {
    ++line_number_;
    fail("the line is too long for a text file");
  }
  std::memmove(block_.data(), block_.data() + begin_, end_ - begin_);
  end_ -= begin_, begin_ = 0;
  in_.read(block_.data() + end_, static_cast<std::streamsize>(block_.size() - end_));
  end_ += static_cast<std::size_t>(in_.gcount());
  if (in_.bad()) throw InputError(fmt::format("cannot read {}", name_));
  return in_.gcount() > 0;
}

bool TextReader::next_raw_line() {
  std::size_t searched = 0;
  while (true) {
    const char* unread = block_.data() + begin_;
    const void* found = std::memchr(unread + searched, '\n', end_ - begin_ - searched);
    if (!found) {
      searched = end_ - begin_;
      if (read_block()) continue;
      if (begin_ == end_) return false;
    }
    const char* stop = found ? static_cast<const char*>(found) : block_.data() + end_;
    line_ = {block_.data() + begin_, static_cast<std::size_t>(stop - block_.data()) - begin_};
    begin_ = std::min(end_, begin_ + line_.size() + 1);
    ++line_number_;
    return true;
  }
}

bool TextReader::next_line() {
  while (next_raw_line())
    if (!line_is_done()) return true;
  return false;
}

bool TextReader::line_is_done() {
  while (!line_.empty() && is_blank(line_.front())) line_.remove_prefix(1);
  return line_.empty() || line_.front() == '#';
}

std::string_view TextReader::word() {
  if (line_is_done()) return {};
  std::size_t size = 0;
  while (size < line_.size() && !is_blank(line_[size])) ++size;
  const std::string_view result = line_.substr(0, size);
  line_.remove_prefix(size);
  return result;
}

double TextReader::number(std::string_view what) {
  if (line_is_done()) fail(fmt::format("{} is missing", what));
  double value = 0;
  const char* end = line_.data() + line_.size();
  const bool plus = line_.size() > 1 && line_[0] == '+' && line_[1] != '-';
  const auto [stop, error] = std::from_chars(line_.data() + plus, end, value);
  const bool whole_word = stop == end || is_blank(*stop);
  if (error != std::errc{} || !whole_word || !std::isfinite(value))
    fail(fmt::format("{} is '{}', not a finite number", what, shown(word())));
  line_.remove_prefix(static_cast<std::size_t>(stop - line_.data()));
  return value;
}

Vec3d TextReader::point(std::string_view what) {
  const double x = number(what), y = number(what), z = number(what);
  return {x, y, z};
}

int TextReader::integer(std::string_view what, int minimum) {
  if (line_is_done()) fail(fmt::format("{} is missing", what));
  const std::string_view text = word();
  int value = 0;
  const auto [stop, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc{} || stop != text.data() + text.size() || value < minimum)
    fail(fmt::format("{} is '{}', not an integer of at least {}", what, shown(text), minimum));
  return value;
}

void TextReader::end_line() {
  if (!line_is_done()) fail(fmt::format("'{}' does not belong on this line", shown(word())));
}

}  // namespace rayshoot
