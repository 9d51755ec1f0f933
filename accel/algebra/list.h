#pragma once

#include "accel/core/optimizer.h"

namespace rayshoot {

/// The null optimizer: all objects are candidates of every ray.
template <class Real>
class List final : public Optimizer<Real>, public SpatialIndex<Real> {
 public:
  using typename SpatialIndex<Real>::ForVoxel;

  explicit List(const OptimizerInput<Real>& input) : box_(input.geometry.bounds()) {
    names_.reserve(input.geometry.size());
    for (std::uint32_t object = 0; object < input.geometry.size(); ++object)
      names_.push_back(input.name(object));
  }

  std::unique_ptr<EngineScratch> scratch() const override { return std::make_unique<EngineScratch>(); }

  bool visit(const Ray<Real>&, EngineScratch&, LevelCount count,
             CandidateVisitor<Real>& visitor) const override {
    count.candidates(names_);
    return visitor(names_);
  }
  void for_each_voxel(const ForVoxel& visit) const override {
    if (!names_.empty()) visit({this, box_, names_});
  }
  bool visit_voxels(const Ray<Real>&, EngineScratch&, LevelCount,
                    VoxelVisitor<Real>& visitor) const override {
    return !names_.empty() && visitor(this, names_);
  }
  const SpatialIndex<Real>* index() const override { return this; }

  StructureStats structure() const override {
    return {.nodes = 1, .leaves = 1, .references = names_.size(), .bytes = names_.size() * sizeof(names_[0])};
  }
  std::size_t levels() const override { return 1; }

 private:
  Box<Real> box_;
  std::vector<std::uint32_t> names_;
};

}  // namespace rayshoot
