#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include "scenes/core/spec.h"

namespace rayshoot {

/// Remembers for one thread which objects its current ray has met, so that an object that several cells refer
/// to is tested once a ray (Arnaldi, Priol & Bouatouch 1987; Arvo & Kirk §5.3): each object carries the
/// number of the last ray that was tested against it.
class Mailbox {
 public:
  /// A mailbox for that many objects; one for none serves where mailboxes are off.
  explicit Mailbox(std::uint32_t objects = 0) : last_ray_(objects, 0) {}

  bool in_use() const { return !last_ray_.empty(); }

  /// Forget what the ray before has met.
  void begin_ray() {
    if (++ray_ != 0) return;
    std::fill(last_ray_.begin(), last_ray_.end(), 0);
    ray_ = 1;
  }

  /// Whether the current ray meets the object for the first time.
  bool first_visit(std::uint32_t object) {
    if (last_ray_[object] == ray_) return false;
    last_ray_[object] = ray_;
    return true;
  }

  bool met(std::uint32_t object) const { return last_ray_[object] == ray_; }

 private:
  std::vector<std::uint32_t> last_ray_;
  std::uint32_t ray_ = 0;
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
