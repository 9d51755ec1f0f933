#pragma once

#include <functional>
#include <span>

#include "accel/parts/mailbox.h"

namespace rayshoot {

/// Hand on the candidates of a cell, but for those whose objects the ray has met; true when the visit must end.
///   once             whether the mailbox is in use
///   name(candidate)  tells which object it is, where several candidates may be one
template <class Candidates, class Name, class Counter, class L>
bool visit_objects_of_cell(const Candidates& candidates, const Name& name, bool once, Mailbox& mailbox,
                           Counter count, L& leaf) {
  count.cell(candidates.empty());
  for (const std::uint32_t candidate : candidates)
    if (once && !mailbox.first_visit(name(candidate)))
      count.mailbox_hit();
    else if (leaf(candidate))
      return true;
  return false;
}

/// `visit` of a technique based on spatial indexing: its candidates are the objects of the cells on the ray. The
/// technique defines
///   visit_cells(ray, count, reach, visit)  call visit(objects) for each cell that the ray meets, near to far, until it
///                                          returns true or no cell that begins within reach() is left
/// A hit may lie beyond the cell in which its object was found (Arvo & Kirk §5.3): the leaf keeps it, and its reach
/// tells when no cell before it is left. Where the mailbox is for no object, objects are tested in every cell.
template <class Technique, class Ray, class Counter, class L>
void visit_objects_of_cells(const Technique& technique, const Ray& ray, Mailbox& mailbox, Counter count,
                            L& leaf) {
  const bool once = mailbox.in_use();
  if (once) mailbox.begin_ray();
  technique.visit_cells(
      ray, count, [&] { return leaf.reach(); },
      [&](std::span<const std::uint32_t> objects) {
        return visit_objects_of_cell(objects, std::identity{}, once, mailbox, count, leaf);
      });
}

}  // namespace rayshoot
