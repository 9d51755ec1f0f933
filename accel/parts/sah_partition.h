#pragma once

#include <tbb/parallel_for.h>

#include <algorithm>

#include "accel/parts/sah_split.h"

namespace rayshoot {

/// A range of objects in two parts, the first `left_count` of them and the others, with what both extend over.
template <class Real>
struct SahHalves {
  std::size_t left_count = 0;
  Extent<Real> left, right;

  void add(const SahHalves& other) {
    left_count += other.left_count;
    left.include(other.left), right.include(other.right);
  }
};

/// Exchange two objects in whole vectors: what is written in smaller pieces cannot be read at once.
template <class Real>
void exchange(BoxedObject<Real>& a, BoxedObject<Real>& b) {
  struct Vectors {
    Lanes<Real> half[2];
  };
  static_assert(sizeof(Vectors) == sizeof a);
  Vectors of_a, of_b;
  std::memcpy(&of_a, &a, sizeof a);
  std::memcpy(&of_b, &b, sizeof b);
  std::memcpy(static_cast<void*>(&a), &of_b, sizeof a);
  std::memcpy(static_cast<void*>(&b), &of_a, sizeof b);
}

/// Reorder a range so that what goes left comes first. Without a branch, since which way an object goes cannot be
/// guessed: each is exchanged with the first of the right part and counts as left or not, and its centre is
/// included on one side and nothing on the other. The boxes of the parts are known from the bins.
template <class Real>
SahHalves<Real> partition(std::span<BoxedObject<Real>> objects, const Bins<Real>& bins,
                          const SahSplit& split) {
  std::size_t left_count = 0;
  SahHalves<Real> halves;
  BoxUnion<Real> left = halves.left.twice_centres, right = left;
  const BoxUnion<Real> none = left;
  for (BoxedObject<Real>& object : objects) {
    const LaneBox<Real> box = object.lanes();
    const Lanes<Real> twice_centre = box.lo + box.hi;
    const auto goes_left = bins.goes_left_lanes(object, split);
    left.include(goes_left ? twice_centre : none.lo, goes_left ? twice_centre : none.hi);
    right.include(goes_left ? none.lo : twice_centre, goes_left ? none.hi : twice_centre);
    exchange(object, objects[left_count]);
    left_count += static_cast<std::size_t>(goes_left[0] & 1);
  }
  halves.left_count = left_count;
  halves.left = {bins.left_box(split), left};
  halves.right = {bins.right_box(split), right};
  return halves;
}

/// The same by all threads: first blocks, then what stands on the wrong side of the middle changes places in pairs. The
/// outcome depends on the blocks, whose size is fixed, and on no thread.
template <class Real>
SahHalves<Real> partition_in_parallel(std::span<BoxedObject<Real>> objects, const Bins<Real>& bins,
                                      const SahSplit& split) {
  constexpr std::size_t kBlock = std::size_t{1} << 14;
  const std::size_t blocks = (objects.size() + kBlock - 1) / kBlock;
  const auto block = [&](std::size_t b) {
    return objects.subspan(b * kBlock, std::min(kBlock, objects.size() - b * kBlock));
  };
  std::vector<SahHalves<Real>> of_block(blocks);
  tbb::parallel_for(std::size_t{0}, blocks,
                    [&](std::size_t b) { of_block[b] = partition(block(b), bins, split); });
  SahHalves<Real> whole;
  for (const SahHalves<Real>& each : of_block) whole.add(each);

  // Places to the left of the middle that hold what goes right, and the other way round: equally many.
  std::vector<std::uint32_t> wrong_left, wrong_right;
  for (std::size_t b = 0; b < blocks; ++b) {
    const std::size_t first = b * kBlock, middle = first + of_block[b].left_count;
    const std::size_t last = first + block(b).size();
    for (std::size_t i = middle; i < std::min(last, whole.left_count); ++i)
      wrong_left.push_back(static_cast<std::uint32_t>(i));
    for (std::size_t i = std::max(first, whole.left_count); i < middle; ++i)
      wrong_right.push_back(static_cast<std::uint32_t>(i));
  }
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, wrong_left.size(), kBlock), [&](const auto& pairs) {
    for (std::size_t i = pairs.begin(); i < pairs.end(); ++i)
      exchange(objects[wrong_left[i]], objects[wrong_right[i]]);
  });
  return whole;
}

}  // namespace rayshoot
