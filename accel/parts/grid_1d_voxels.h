#pragma once

#include <array>
#include <atomic>
#include <memory>
#include <mutex>
#include <span>

#include "accel/core/technique.h"
#include "accel/parts/grid_1d_costs.h"
#include "accel/parts/grid_1d_states.h"

namespace rayshoot {

template <class Real>
struct SubdividedVoxel;

/// A word that says what a subvoxel is: subdivided, a leaf with its objects, or an undecided candidate that no ray
/// has come to yet. Threads read it while one of them replaces the last by one of the others.
template <class Real>
class Subvoxel {
 public:
  using Voxel = SubdividedVoxel<Real>;
  /// What the word said when it was read.
  class Content {
   public:
    explicit Content(std::uintptr_t bits = 0) : bits_(bits) {}
    static Content leaf(const std::uint32_t* list) { return Content(reinterpret_cast<std::uintptr_t>(list)); }
    static Content undecided(const std::uint32_t* list) { return Content(leaf(list).bits_ | kUndecided); }
    static Content subdivided(const Voxel* voxel) {
      return Content(reinterpret_cast<std::uintptr_t>(voxel) | kSubdivided);
    }

    bool undecided() const { return bits_ & kUndecided; }
    bool subdivided() const { return bits_ & kSubdivided; }
    const Voxel* voxel() const { return reinterpret_cast<const Voxel*>(bits_ - kSubdivided); }
    /// The list of an undecided or unsubdivided one: the number of objects, then the objects.
    const std::uint32_t* list() const {
      return reinterpret_cast<const std::uint32_t*>(bits_ & ~(kUndecided | kSubdivided));
    }
    std::span<const std::uint32_t> objects() const {
      const std::uint32_t* objects = list();
      return objects ? std::span(objects + 1, *objects) : std::span<const std::uint32_t>();
    }

   private:
    friend class Subvoxel;
    static constexpr std::uintptr_t kSubdivided = 1, kUndecided = 2;
    std::uintptr_t bits_;
  };

  Content read() const { return Content(bits_.load(std::memory_order_acquire)); }
  void publish(Content content) { bits_.store(content.bits_, std::memory_order_release); }

 private:
  std::atomic<std::uintptr_t> bits_{0};
};

/// What is needed of a subdivided voxel when its subvoxels are decided about.
template <class Real>
struct VoxelContext {
  /// The voxel of which it is a subvoxel.
  const SubdividedVoxel<Real>* parent = nullptr;
  Box<Real> box{};
  std::uint64_t absolute_granularity = 1;
  /// On each axis, the number of the subvoxel of the lowest voxel above in which it lies.
  std::array<std::uint64_t, 3> numbers{};
  double estimated_num_rays = 0;
  /// References in all its subvoxels, and how many more voxels below it may add.
  std::uint64_t references = 0;
  double spare_references = 0;
};

/// A subdivided voxel as rays see it. Its array of subvoxels and the planes between them stand behind it in memory.
template <class Real>
struct SubdividedVoxel {
  /// The lowest voxels above it that are subdivided along x, y and z; null where there is none.
  const SubdividedVoxel* above[3] = {};
  const VoxelContext<Real>* context = nullptr;
  /// Its minimum extent: the number of its first subvoxel among those of its absolute granularity.
  std::uint64_t first = 0;
  Real subvoxels_per_length = 0;
  std::uint32_t granularity = 0;
  /// Its traversal state.
  std::uint32_t state = 0;
  std::int32_t axis = 0;

  const Subvoxel<Real>* subvoxels() const { return reinterpret_cast<const Subvoxel<Real>*>(this + 1); }
  /// granularity + 1 positions.
  const Real* planes() const { return reinterpret_cast<const Real*>(subvoxels() + granularity); }
  std::uint64_t maximum_extent() const { return first + granularity; }

  static std::size_t bytes(std::size_t granularity) {
    return sizeof(SubdividedVoxel) + granularity * sizeof(Subvoxel<Real>) + (granularity + 1) * sizeof(Real);
  }
};

/// alternate: the paper's, the axis of a voxel follows from its depth; paying: the next axis on which the cost
/// function subdivides.
enum class AxisRule { alternate, paying };

struct Grid1dRules {
  CodeTimings timings = kDefaultTimings;
  int maximum_granularity = 20;
  AxisRule axes = AxisRule::alternate;
};

/// The voxels of a scene, subdivided where rays come. They are shared by all threads: one subdivides at a time, what
/// it makes depends on the voxel and the sample of rays alone, and the others see a voxel whole or not at all.
template <class Real>
class Grid1dVoxels {
 public:
  using Voxel = SubdividedVoxel<Real>;
  using Content = typename Subvoxel<Real>::Content;

  /// Subdivide what the sample of rays comes to, breadth first. Without a sample, or where it misses the scene, it is
  /// one of random lines.
  Grid1dVoxels(const Geometry<Real>& geometry, const RaySample<Real>& sample, const Grid1dRules& rules);

  /// The voxel of the whole scene.
  Content root() const { return root_.read(); }
  const Box<Real>& box() const { return geometry_.bounds(); }

  /// Decide about an undecided subvoxel, as a ray is about to traverse it.
  [[gnu::noinline, gnu::cold]] Content decide(const Voxel& parent, std::uint32_t index);

  /// What there is so far.
  StructureStats structure() const;

 private:
  /// A voxel about which nothing is decided.
  struct Candidate {
    Subvoxel<Real>* slot = nullptr;
    const Voxel* parent = nullptr;
    const std::uint32_t* list = nullptr;
    Box<Real> box{};
    /// As of its context when it is subdivided.
    std::array<std::uint64_t, 3> numbers{};
    double estimated_num_rays = 0;
    double spare_references = 0;
    /// Positions of the sample rays through it.
    std::vector<std::uint32_t> sample{};

    std::span<const std::uint32_t> objects() const { return {list + 1, *list}; }
    const Voxel* above(int axis) const {
      return !parent ? nullptr : parent->axis == axis ? parent : parent->above[axis];
    }
  };
  /// How a candidate is to be cut.
  struct Cut {
    int axis = 0;
    int granularity = 0;
  };
  /// The subvoxels that an object gets into.
  struct Range {
    std::uint32_t first, last;
  };

  void traverse_breadth_first(std::vector<Ray<Real>> rays, double rays_each, bool occluded);
  void end_at_hits(const Candidate& leaf, std::vector<Ray<Real>>& rays) const;
  void hand_down(const Candidate& from, const std::vector<Ray<Real>>& rays, double rays_each,
                 std::vector<Candidate>& children);
  Candidate subvoxel_of(const Voxel& parent, std::uint32_t index) const;
  Content subdivide(const Candidate& candidate);
  Cut choose_cut(const Candidate& candidate) const;
  Vec3d mean_sizes(const Candidate& candidate) const;
  std::uint64_t absolute_granularity(const Candidate& candidate, const Cut& cut) const;
  bool separable(const Candidate& candidate, const Cut& cut) const;
  Voxel* new_voxel(const Candidate& candidate, const Cut& cut, std::uint64_t absolute);
  bool sort_objects(const Candidate& candidate, Voxel& voxel, VoxelContext<Real>& context);
  Range range_of(std::uint32_t object, const Voxel& voxel) const;
  void add(const Content& content, std::uint64_t depth, StructureStats& stats) const;
  std::byte* allocate(std::size_t bytes, std::size_t alignment = 8);
  std::uint32_t* new_list(std::uint32_t objects);

  const Geometry<Real>& geometry_;
  Grid1dRules rules_;
  /// Planes nearer than this are not told apart.
  Real apart_ = 0;
  Subvoxel<Real> root_;
  mutable std::mutex mutex_;
  TraversalStateTable states_;
  /// Memory that stays where it is: blocks, and what is left of the last.
  std::vector<std::unique_ptr<std::byte[]>> blocks_;
  std::byte* free_ = nullptr;
  std::size_t free_bytes_ = 0, bytes_ = 0;
};

extern template class Grid1dVoxels<float>;
extern template class Grid1dVoxels<double>;

}  // namespace rayshoot
