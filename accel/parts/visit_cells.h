#pragma once

#include <span>

#include "accel/parts/mailbox.h"

namespace rayshoot {

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
        count.cell(objects.empty());
        for (const std::uint32_t object : objects)
          if (once && !mailbox.first_visit(object))
            count.mailbox_hit();
          else if (leaf(object))
            return true;
        return false;
      });
}

}  // namespace rayshoot
