#pragma once

#include <tbb/parallel_invoke.h>

#include <numeric>

#include "accel/parts/pair_tree.h"
#include "accel/parts/sah_partition.h"

namespace rayshoot {

/// Objects in clusters of neighbours, each a few objects one behind the other: what a hierarchy can be built over in place of
/// the objects, as J. Pantaleoni & D. Luebke do in "HLBVH: hierarchical LBVH construction for real-time ray tracing of dynamic
/// geometry", 2010. Where they sort along a Morton curve, the objects are cut in two at the middle of the longest axis of their
/// centres, again and again: that follows the objects where they are dense, and needs no code.
template <class Real>
class SahClusters {
 public:
  /// Clusters of at most so many objects, 255 or less, which are reordered.
  SahClusters(std::span<BoxedObject<Real>> objects, const Extent<Real>& extent, std::size_t most)
      : objects_(objects), most_(most), sizes_(objects.size()) {
    cut(0, objects.size(), extent, 0);
    for (std::size_t first = 0; first < objects.size(); first += sizes_[first])
      firsts_.push_back(static_cast<std::uint32_t>(first));
  }

  /// Every cluster as one object, named by its number.
  HugeVector<BoxedObject<Real>> boxed() const {
    HugeVector<BoxedObject<Real>> clusters(firsts_.size());
    tbb::parallel_for(tbb::blocked_range<std::uint32_t>(0, static_cast<std::uint32_t>(firsts_.size())),
                      [&](const auto& part) {
                        for (std::uint32_t i = part.begin(); i < part.end(); ++i) {
                          BoxUnion<Real> box = BoxUnion<Real>::empty();
                          for (const BoxedObject<Real>& object : members(i)) box.include(object.lanes());
                          clusters[i] = {Box<Real>(box), i};
                        }
                      });
    return clusters;
  }

  /// Reorder the objects so that the clusters stand in that order; returns the leaf that each then is.
  std::vector<ChildReference> arrange(std::span<const BoxedObject<Real>> clusters) {
    std::vector<ChildReference> leaves(clusters.size());
    std::uint32_t first = 0;
    for (std::size_t i = 0; i < clusters.size(); ++i) {
      leaves[i] = {first, static_cast<std::uint32_t>(members(clusters[i].object).size())};
      first += leaves[i].count;
    }
    const HugeVector<BoxedObject<Real>> copies(objects_.begin(), objects_.end());
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, clusters.size()), [&](const auto& part) {
      for (std::size_t i = part.begin(); i < part.end(); ++i)
        std::copy_n(copies.begin() + firsts_[clusters[i].object], leaves[i].count,
                    objects_.begin() + leaves[i].first);
    });
    return leaves;
  }

 private:
  /// Smaller ranges are cut by one thread, larger ones than the second by all.
  static constexpr std::size_t kSequentialObjects = 4096, kParallelObjects = std::size_t{1} << 16;

  /// Times the area of the second largest object of a cluster.
  static constexpr double kMuchLarger = 64;

  std::span<const BoxedObject<Real>> members(std::uint32_t cluster) const {
    return objects_.subspan(firsts_[cluster], sizes_[firsts_[cluster]]);
  }

  void cut(std::size_t first, std::size_t last, const Extent<Real>& extent, int depth) {
    const std::span<BoxedObject<Real>> range = objects_.subspan(first, last - first);
    if (range.size() <= most_) return finish(first, range);
    const SahHalves<Real> halves =
        depth < kBalancedDepth ? cut_in_two(range, extent) : by_number(range, extent);
    const std::size_t middle = first + halves.left_count;
    const auto cut_left = [&] { cut(first, middle, halves.left, depth + 1); };
    const auto cut_right = [&] { cut(middle, last, halves.right, depth + 1); };
    if (range.size() > kSequentialObjects)
      tbb::parallel_invoke(cut_left, cut_right);
    else
      cut_left(), cut_right();
  }

  /// The range is a cluster. An object much larger than all others is one of its own: it would make the cluster as large.
  void finish(std::size_t first, std::span<BoxedObject<Real>> range) {
    double largest = 0, second = 0;
    std::size_t which = 0;
    for (std::size_t i = 0; i < range.size(); ++i) {
      const LaneBox<Real> box = range[i].lanes();
      const double area = BoxUnion<Real>{box.lo, box.hi}.half_area();
      second = std::max(second, std::min(area, largest));
      if (area > largest) largest = area, which = i;
    }
    const bool alone = range.size() > 1 && largest > kMuchLarger * second;
    if (alone) exchange(range[0], range[which]);
    sizes_[first] = static_cast<std::uint8_t>(alone ? 1 : range.size());
    if (alone) sizes_[first + 1] = static_cast<std::uint8_t>(range.size() - 1);
  }

  /// Two bins along the longest axis; by number where all centres are the same.
  static SahHalves<Real> cut_in_two(std::span<BoxedObject<Real>> range, const Extent<Real>& extent) {
    const Bins<Real> bins(extent, 2);
    const SahSplit split{.axis = extent.longest_axis(), .place = 1};
    SahHalves<Real> halves = range.size() > kParallelObjects ? partition_in_parallel(range, bins, split)
                                                             : partition(range, bins, split);
    if (halves.left_count == 0 || halves.left_count == range.size()) return by_number(range, extent);
    return halves;
  }
  static SahHalves<Real> by_number(std::span<const BoxedObject<Real>> range, const Extent<Real>& extent) {
    return {range.size() / 2, extent, extent};
  }

  std::span<BoxedObject<Real>> objects_;
  const std::size_t most_;
  /// Of the cluster that begins there, by the number of its first object; and these numbers.
  std::vector<std::uint8_t> sizes_;
  std::vector<std::uint32_t> firsts_;
};

}  // namespace rayshoot
