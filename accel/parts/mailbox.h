#pragma once

#include <algorithm>
#include <bit>
#include <cstdint>
#include <vector>

#include "scenes/core/spec.h"

namespace rayshoot {

/// Remembers for one thread which objects its current ray has met, so that an object that several cells refer
/// to is tested once a ray (Arnaldi, Priol & Bouatouch 1987; Arvo & Kirk §5.3): each object carries the
/// number of the last ray that was tested against it. Those numbers stand in a table by hash, as large as the rays
/// so far asked for and half empty at least: what a ray has met stays in the nearest cache then.
class Mailbox {
 public:
  /// A mailbox for that many objects; one for none serves where mailboxes are off.
  explicit Mailbox(std::uint32_t objects = 0) {
    if (objects > 0) resize(kFirstSlots);
  }

  bool in_use() const { return !slots_.empty(); }

  /// Forget what the ray before has met.
  void begin_ray() {
    met_ = 0;
    if (++ray_ != 0) return;
    std::fill(slots_.begin(), slots_.end(), Letter{});
    ray_ = 1;
  }

  /// Whether the current ray meets the object for the first time.
  bool first_visit(std::uint32_t object) {
    Letter& letter = slots_[slot_of(object)];
    if (letter.ray == ray_) return false;
    letter = {ray_, object};
    if (++met_ > slots_.size() / 2) [[unlikely]]
      grow();
    return true;
  }

  bool met(std::uint32_t object) const { return slots_[slot_of(object)].ray == ray_; }

 private:
  static constexpr std::size_t kFirstSlots = 256;
  struct Letter {
    std::uint32_t ray = 0, object = 0;
  };

  void resize(std::size_t slots) {
    slots_.assign(slots, {});
    shift_ = 32 - std::countr_zero(slots);
  }

  /// The slot of an object that the ray has met, or the one in which its search ends (multiplicative hashing, linear
  /// probing).
  std::size_t slot_of(std::uint32_t object) const {
    std::size_t slot = (object * 0x9E3779B9u) >> shift_;
    while (slots_[slot].ray == ray_ && slots_[slot].object != object) slot = (slot + 1) & (slots_.size() - 1);
    return slot;
  }

  [[gnu::noinline, gnu::cold]] void grow() {
    const std::vector<Letter> before = std::move(slots_);
    resize(2 * before.size());
    for (const Letter& letter : before)
      if (letter.ray == ray_) slots_[slot_of(letter.object)] = letter;
  }

  std::vector<Letter> slots_;
  std::uint32_t ray_ = 0;
  int shift_ = 0;
  /// Objects that the current ray has met.
  std::size_t met_ = 0;
};

enum class MailboxUse { automatic, on, off };

inline Parameter mailbox_parameter() {
  return choice_parameter(
      "mailbox", "auto", {"auto", "on", "off"},
      "test an object once a ray however many cells refer to it; auto: where some object is "
      "referred to twice");
}

inline MailboxUse mailbox_use(const Arguments& arguments) {
  const std::string& use = arguments.text("mailbox");
  return use == "on" ? MailboxUse::on : use == "off" ? MailboxUse::off : MailboxUse::automatic;
}

/// Whether a structure with that many references to that many objects, each referred to at least once, gets a
/// mailbox: automatically where some object has a second reference, for nothing is tested twice elsewhere.
inline bool wants_mailbox(MailboxUse use, std::uint64_t references, std::uint64_t objects) {
  return use == MailboxUse::automatic ? references > objects : use == MailboxUse::on;
}

}  // namespace rayshoot
