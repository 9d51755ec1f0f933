#include "harness/plan/shard.h"

#include <fmt/format.h>

#include <charconv>

#include "scenes/core/spec.h"

namespace rayshoot {

namespace {

/// The whole of a text as a number; 0 where it is none.
std::size_t number_in(std::string_view text) {
  std::size_t number = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  return error == std::errc() && end == text.data() + text.size() ? number : 0;
}

}  // namespace

Shard parse_shard(const std::string& text) {
  const std::size_t slash = text.find('/');
  Shard shard{0, 0};
  if (slash != std::string::npos)
    shard = {number_in(std::string_view(text).substr(0, slash)),
             number_in(std::string_view(text).substr(slash + 1))};
  if (shard.index == 0 || shard.index > shard.count)
    throw InputError(fmt::format("'{}' is no shard; the second of three is 2/3", text));
  return shard;
}

void keep_shard(Plan& plan, const Shard& shard) {
  auto& scenes = plan.suite.scenes;
  if (shard.count > scenes.size())
    throw InputError(
        fmt::format("there are {} scenes, and so at most {} shards", scenes.size(), scenes.size()));
  const auto border = [&](std::size_t index) {
    return scenes.begin() + static_cast<std::ptrdiff_t>(index * scenes.size() / shard.count);
  };
  scenes = std::vector(border(shard.index - 1), border(shard.index));
}

}  // namespace rayshoot
