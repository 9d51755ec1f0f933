#include "accel/parts/bsp_build.h"

#include <numeric>

#include "accel/parts/octree_build.h"

namespace rayshoot {

std::vector<Parameter> bsp_parameters() {
  return {integer_parameter("max_depth", 0, 0, kMaxAxisTreeDepth - 1,
                            "divisions above a leaf at the most; 0: suited to the number of objects"),
          integer_parameter("max_objects", BspConfig{}.max_objects, 1, 1'000'000,
                            "a cell with that many objects or fewer is not divided"),
          mailbox_parameter()};
}

BspConfig bsp_config(const Arguments& arguments) {
  return {.max_depth = static_cast<int>(arguments.integer("max_depth")),
          .max_objects = static_cast<std::uint32_t>(arguments.integer("max_objects")),
          .mailbox = mailbox_use(arguments)};
}

namespace {

template <class Real>
class BspBuilder {
 public:
  BspBuilder(const Geometry<Real>& geometry, const BspConfig& config)
      : geometry_(geometry),
        max_objects_(config.max_objects),
        max_depth_(config.max_depth ? config.max_depth
                                    : std::min(3 * suitable_depth(geometry.size()), kMaxAxisTreeDepth - 1)),
        max_references_(OctreeLimits{}.references_per_object * geometry.size() + kSpareReferences) {}

  AxisTree<Real> build() && {
    if (geometry_.size() == 0) return {};
    tree_.box = geometry_.bounds();
    std::vector<std::uint32_t> objects(geometry_.size());
    std::iota(objects.begin(), objects.end(), 0u);
    references_ = objects.size();
    divide(tree_.box, std::move(objects), 0, 0);
    return std::move(tree_);
  }

 private:
  using Node = typename AxisTree<Real>::Node;

  /// `in_vain` divisions above have separated nothing.
  void divide(const Box<Real>& cell, std::vector<std::uint32_t> objects, int depth, int in_vain) {
    const int axis = depth % 3;
    const Real plane = cell.centre()[axis];
    const bool divisible = cell.lo[axis] < plane && plane < cell.hi[axis];
    if (objects.size() <= max_objects_ || depth >= max_depth_ || in_vain >= 3 || !divisible ||
        references_ > max_references_)
      return add_leaf(objects);

    std::vector<std::uint32_t> below, above;
    for (const std::uint32_t object : objects) {
      const Box<Real> bounds = geometry_.bounds(object);
      if (bounds.lo[axis] <= plane) below.push_back(object);
      if (bounds.hi[axis] >= plane) above.push_back(object);
    }
    const std::size_t whole = objects.size();
    references_ += below.size() + above.size() - whole;
    in_vain = below.size() == whole && above.size() == whole ? in_vain + 1 : 0;
    objects = {};

    Box<Real> lower_cell = cell, upper_cell = cell;
    lower_cell.hi[axis] = upper_cell.lo[axis] = plane;
    const std::size_t node = tree_.nodes.size();
    tree_.nodes.push_back(Node::interior(axis, plane));
    divide(lower_cell, std::move(below), depth + 1, in_vain);
    tree_.nodes[node].link_upper(static_cast<std::uint32_t>(tree_.nodes.size() - node));
    divide(upper_cell, std::move(above), depth + 1, in_vain);
  }

  void add_leaf(const std::vector<std::uint32_t>& objects) {
    tree_.nodes.push_back(Node::leaf(static_cast<std::uint32_t>(tree_.references.size()),
                                     static_cast<std::uint32_t>(objects.size())));
    tree_.references.insert(tree_.references.end(), objects.begin(), objects.end());
  }

  const Geometry<Real>& geometry_;
  std::size_t max_objects_;
  int max_depth_;
  std::uint64_t max_references_, references_ = 0;
  AxisTree<Real> tree_;
};

}  // namespace

template <class Real>
AxisTree<Real> build_bsp(const Geometry<Real>& geometry, const BspConfig& config) {
  return BspBuilder<Real>(geometry, config).build();
}

template AxisTree<float> build_bsp(const Geometry<float>&, const BspConfig&);
template AxisTree<double> build_bsp(const Geometry<double>&, const BspConfig&);

}  // namespace rayshoot
