#pragma once

#include <algorithm>
#include <array>
#include <functional>
#include <memory>
#include <span>

#include "accel/core/technique.h"
#include "accel/parts/mailbox.h"

namespace rayshoot {

/// One thread's working memory for one engine or optimizer.
class EngineScratch {
 public:
  virtual ~EngineScratch() = default;
};

/// What the levels of a composition did for a ray: deeper ones are counted with the last.
class LevelWork {
 public:
  static constexpr std::size_t kMostLevels = kMostEventKinds / 2;

  explicit LevelWork(std::uint32_t objects) { met_.fill(Mailbox(objects)); }

  void begin_ray() {
    works_.fill({});
    for (Mailbox& met : met_) met.begin_ray();
  }
  Work& work(std::size_t level) { return works_[level]; }
  void candidate(std::size_t level, std::uint32_t object) {
    ++works_[level].object_tests;
    works_[level].distinct_objects += met_[level].first_visit(object);
  }

 private:
  std::array<Work, kMostLevels> works_{};
  /// The candidates of each level.
  std::array<Mailbox, kMostLevels> met_;
};

/// Where the work of some level and those below it is counted; nowhere in a timed visit.
class LevelCount {
 public:
  LevelCount() = default;
  explicit LevelCount(LevelWork& levels) : levels_(&levels) {}

  bool counts() const { return levels_ != nullptr; }
  Count counter() const { return Count(levels_->work(level_)); }
  void candidate(std::uint32_t object) const {
    if (counts()) levels_->candidate(level_, object);
  }
  void candidates(std::span<const std::uint32_t> objects) const {
    if (counts())
      for (const std::uint32_t object : objects) levels_->candidate(level_, object);
  }
  LevelCount below(std::size_t levels) const {
    LevelCount deeper = *this;
    deeper.level_ = std::min(level_ + levels, LevelWork::kMostLevels - 1);
    return deeper;
  }

 private:
  LevelWork* levels_ = nullptr;
  std::size_t level_ = 0;
};

/// Who asks an optimizer for candidates, as a leaf does (technique.h), where it is known at run time alone.
template <class Real>
class CandidateVisitor {
 public:
  /// Take candidates in that order; true when the visit must end.
  virtual bool operator()(std::span<const std::uint32_t> objects) = 0;
  /// The distance beyond which nothing matters any more.
  Real reach() const { return reach_; }

 protected:
  explicit CandidateVisitor(Real reach) : reach_(reach) {}
  ~CandidateVisitor() = default;
  Real reach_;
};

/// A voxel of a spatial representation m(s) (Revelles & Ureña §4.6): what can lie in `box` are parts of `objects`. A
/// technique knows it again by its key.
template <class Real>
struct Voxel {
  using Key = const void*;
  Key key;
  Box<Real> box;
  std::span<const std::uint32_t> objects;
  /// Rays from far away are shown it where they pass it by, and hits outside of it count (parts/surface_margin.h).
  bool widened = false;
  /// In a composition, the voxels around it: a ray is shown it only where it has met them all. They may be smaller than it.
  std::vector<Box<Real>> around{};
};

/// Who asks a spatial index for the voxels on a ray.
template <class Real>
class VoxelVisitor {
 public:
  /// Take a voxel that has objects, and these; true when the visit must end.
  virtual bool operator()(typename Voxel<Real>::Key voxel, std::span<const std::uint32_t> objects) = 0;
  /// The distance beyond which nothing matters any more.
  Real reach() const { return reach_; }

 protected:
  explicit VoxelVisitor(Real reach) : reach_(reach) {}
  ~VoxelVisitor() = default;
  Real reach_;
};

/// The spatial index of an optimizer that is based on one (equation 14): its candidates are the objects of the voxels on the
/// ray.
template <class Real>
class SpatialIndex {
 public:
  using ForVoxel = std::function<void(const Voxel<Real>&)>;

  /// The voxels of m(s) that have objects: together they hold all that can be hit (equation 12).
  virtual void for_each_voxel(const ForVoxel& visit) const = 0;
  /// Give those that a ray meets, near to far where the technique can; whether the visitor ended it.
  virtual bool visit_voxels(const Ray<Real>& ray, EngineScratch& scratch, LevelCount count,
                            VoxelVisitor<Real>& visitor) const = 0;

 protected:
  ~SpatialIndex() = default;
};

/// An optimizer A(r, s) of Revelles and Ureña, built over a scene, behind virtual calls: a technique that is part of a
/// composition. Objects are called by the names given when it was built. Const: threads share it, each with a scratch of its
/// own.
template <class Real>
class Optimizer {
 public:
  virtual ~Optimizer() = default;

  virtual std::unique_ptr<EngineScratch> scratch() const = 0;
  /// Give the candidates of a ray that has begun, near to far where the technique can; whether the visitor ended it.
  virtual bool visit(const Ray<Real>& ray, EngineScratch& scratch, LevelCount count,
                     CandidateVisitor<Real>& visitor) const = 0;
  /// Null where it is not based on spatial indexing.
  virtual const SpatialIndex<Real>* index() const { return nullptr; }

  virtual StructureStats structure() const = 0;
  /// Techniques one below the other.
  virtual std::size_t levels() const = 0;
};

/// What an optimizer is built from: a scene, which outlives it, and what its objects are called; nothing for their numbers.
template <class Real>
struct OptimizerInput {
  const Geometry<Real>& geometry;
  std::span<const std::uint32_t> names{};
  RaySample<Real> sample{};

  std::uint32_t name(std::uint32_t object) const { return names.empty() ? object : names[object]; }
};

}  // namespace rayshoot
