#pragma once

#include <fmt/format.h>

#include <cstdint>
#include <cstring>
#include <span>
#include <string>
#include <type_traits>

namespace rayshoot {

/// An order-sensitive 64-bit digest (FNV-1a over 8-byte words) of plain values, to recognise equal scenes,
/// ray sets and answers. Not for security.
class Digest {
 public:
  /// Add the bytes of one value, which must have no padding.
  template <class T>
  void add(const T& value) {
    static_assert(std::is_trivially_copyable_v<T>);
    for (std::size_t at = 0; at < sizeof(T); at += sizeof(std::uint64_t)) {
      std::uint64_t word = 0;
      std::memcpy(&word, reinterpret_cast<const char*>(&value) + at, std::min(sizeof(word), sizeof(T) - at));
      state_ = (state_ ^ word) * 0x100000001B3ull;
      state_ ^= state_ >> 32;
    }
  }

  template <class Range>
  void add_all(const Range& values) {
    for (const auto& value : values) add(value);
  }

  std::uint64_t value() const { return state_; }
  /// The digest as 16 hexadecimal digits.
  std::string hex() const { return fmt::format("{:016x}", state_); }

 private:
  std::uint64_t state_ = 0xCBF29CE484222325ull;
};

}  // namespace rayshoot
