#pragma once

#include <utility>

#include "accel/core/optimizer.h"

namespace rayshoot {

/// A technique whose candidates are the objects of the cells on the ray.
template <class A>
concept HasCells = requires(const A a, typename A::Scratch scratch) {
  a.cells(scratch);
  a.for_each_cell([](const Box<typename A::Scalar>&, typename Voxel<typename A::Scalar>::Key,
                     std::span<const std::uint32_t>) {});
};

/// A technique as part of a composition.
template <Technique A>
class TechniqueOptimizer : public Optimizer<typename A::Scalar> {
 public:
  using Real = typename A::Scalar;

  TechniqueOptimizer(const OptimizerInput<Real>& input, const Arguments& arguments)
      : technique_(A::build({input.geometry, input.sample}, A::configure(arguments))) {
    renames_ = OrdersObjects<A> || !input.names.empty();
    const std::size_t positions = count_of_positions(input.geometry.size());
    names_.reserve(positions);
    for (std::uint32_t position = 0; position < positions; ++position)
      names_.push_back(input.name(object_at(position)));
  }

  std::unique_ptr<EngineScratch> scratch() const override {
    return std::make_unique<Scratch>(technique_.scratch());
  }

  bool visit(const Ray<Real>& ray, EngineScratch& scratch, LevelCount count,
             CandidateVisitor<Real>& visitor) const override {
    struct Leaf {
      const std::uint32_t* names;
      CandidateVisitor<Real>& visitor;
      LevelCount count;
      bool ended = false;

      bool operator()(std::uint32_t position) {
        count.candidates({names + position, 1});
        return ended = visitor({names + position, 1});
      }
      Real reach() const { return visitor.reach(); }
    } leaf{names_.data(), visitor, count};
    if (count.counts())
      technique_.visit(ray, own(scratch), count.counter(), leaf);
    else
      technique_.visit(ray, own(scratch), NoCount{}, leaf);
    return leaf.ended;
  }

  StructureStats structure() const override { return technique_.structure(); }
  std::size_t levels() const override { return 1; }

 protected:
  struct Scratch final : EngineScratch {
    explicit Scratch(typename A::Scratch own) : technique(std::move(own)) {}
    typename A::Scratch technique;
    /// What the objects of a cell are called.
    std::vector<std::uint32_t> named{};
  };
  static typename A::Scratch& own(EngineScratch& scratch) { return static_cast<Scratch&>(scratch).technique; }

  A technique_;
  /// What the object at each position is called.
  std::vector<std::uint32_t> names_;
  /// Whether that is not the position itself.
  bool renames_ = false;

 private:
  std::size_t count_of_positions(std::size_t objects) const {
    if constexpr (OrdersObjects<A>)
      return technique_.order().size();
    else
      return objects;
  }
  std::uint32_t object_at(std::uint32_t position) const {
    if constexpr (OrdersObjects<A>)
      return technique_.order()[position];
    else
      return position;
  }
};

/// A technique based on spatial indexing as part of a composition.
template <Technique A>
requires HasCells<A>
class TechniqueIndex final : public TechniqueOptimizer<A>, public SpatialIndex<typename A::Scalar> {
 public:
  using Real = typename A::Scalar;
  using typename SpatialIndex<Real>::ForVoxel;

  TechniqueIndex(const OptimizerInput<Real>& input, const Arguments& arguments)
      : TechniqueOptimizer<A>(input, arguments) {
    if constexpr (requires { this->technique_.prepare_cells(); }) this->technique_.prepare_cells();
  }

  const SpatialIndex<Real>* index() const override { return this; }

  void for_each_voxel(const ForVoxel& visit) const override {
    std::vector<std::uint32_t> objects;
    bool widened = false;
    if constexpr (requires { this->technique_.widens_cells(); }) widened = this->technique_.widens_cells();
    this->technique_.for_each_cell(
        [&](const Box<Real>& box, typename Voxel<Real>::Key key, std::span<const std::uint32_t> positions) {
          objects.clear();
          for (const std::uint32_t position : positions) objects.push_back(this->names_[position]);
          visit({key, box, objects, widened});
        });
  }

  bool visit_voxels(const Ray<Real>& ray, EngineScratch& scratch, LevelCount count,
                    VoxelVisitor<Real>& visitor) const override {
    auto& own = static_cast<typename TechniqueOptimizer<A>::Scratch&>(scratch);
    return count.counts() ? visit_cells(ray, own, count.counter(), visitor)
                          : visit_cells(ray, own, NoCount{}, visitor);
  }

 private:
  template <class Counter>
  [[gnu::flatten]] bool visit_cells(const Ray<Real>& ray, typename TechniqueOptimizer<A>::Scratch& scratch,
                                    Counter count, VoxelVisitor<Real>& visitor) const {
    bool ended = false;
    this->technique_.cells(scratch.technique)
        .visit_cells(
            ray, count, [&] { return visitor.reach(); },
            [&](std::span<const std::uint32_t> objects) {
              count.cell(objects.empty());
              return ended = !objects.empty() && visitor(objects.data(), named(objects, scratch.named));
            });
    return ended;
  }

  std::span<const std::uint32_t> named(std::span<const std::uint32_t> positions,
                                       std::vector<std::uint32_t>& room) const {
    if (!this->renames_) return positions;
    room.resize(positions.size());
    std::transform(positions.begin(), positions.end(), room.begin(),
                   [&](std::uint32_t position) { return this->names_[position]; });
    return room;
  }
};

}  // namespace rayshoot
