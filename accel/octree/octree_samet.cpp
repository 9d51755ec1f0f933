// Octree traversal by neighbour finding
// H. Samet, "Implementing ray tracing with octrees and neighbor finding", 1989.
//
// Idea       The ray goes from leaf to leaf. The neighbour across the face by which it leaves is found through links: up
//            to the nearest common ancestor, the first of which the leaf is in the nearer half, and down again by the
//            mirror image of the way. Where the neighbour is divided, the ray tells which of its leaves it enters.
// Parameters max_depth, max_objects, assignment, split, separating, mailbox
//                         of the octree, as octree_revelles has them
// Cost       links followed, which are the steps: on average four for a neighbour, wherever in the tree it is, against
//            the whole depth for octree_glassner. 4 bytes for every eight nodes more than octree_revelles.
// Weak       neighbours on two sides of a plane high in the tree have a long way to each other.
//
// Exactness  The links lead through the inside of a face alone; where the ray may leave by an edge or a vertex, the leaves
//            touched are searched from the root (leaf_order.h).

#include "accel/core/define_technique.h"
#include "accel/parts/octree_technique.h"

namespace rayshoot {

namespace {

template <class Real>
class OctreeSamet : public OctreeTechnique<OctreeSamet, Real> {
  using Base = OctreeTechnique<OctreeSamet, Real>;
  using Base::cells_;
  using typename Base::Cell, typename Base::Node;

 public:
  static TechniqueInfo info() {
    return {.id = "octree_samet",
            .title = "Octree, neighbour finding",
            .family = "octree",
            .survey_section = "5.1",
            .paper = "Samet 1989",
            .parameters = OctreeCells<Real>::parameters(),
            .events = {"links_up", "links_down"}};
  }

  static OctreeSamet build(const BuildInput<Real>& in, const OctreeCellsConfig& config) {
    OctreeSamet technique = Base::build(in, config);
    technique.link_parents();
    return technique;
  }

  StructureStats structure() const {
    StructureStats stats = cells_.structure();
    stats.bytes += parents_.size() * sizeof(parents_[0]);
    return stats;
  }

  template <class Counter, class Reach, class Visit>
  void traverse(const Ray<Real>& ray, Counter count, const Reach& reach, const Visit& visit) const {
    const LatticeRay<Real> path(cells_.lattice(), ray);
    const LeafOrder<Real, OctreeCells<Real>> order(cells_, path, cells_.lattice());
    const auto down = [&] { count.step(), count.event(links_down); };
    const auto across = [&](Cell& leaf, int axis, Real first) {
      if (!find_neighbour(leaf, axis, path, count)) return false;
      // Go down to the neighbour that the ray enters, where several smaller ones touch the face.
      leaf = order.first_leaf(leaf, first, down);
      return true;
    };
    order.walk(ray.t_min, reach, down, across,
               [&](const Cell& leaf) { return visit(cells_.objects(*leaf.node)); });
  }

 private:
  enum Event : std::size_t { links_up, links_down };

  /// The neighbour of equal or larger size across the farther face on an axis; false when there is none.
  template <class Counter>
  bool find_neighbour(Cell& cell, int axis, const LatticeRay<Real>& path, Counter count) const {
    // Go up to the nearest common ancestor: that of which the cell is in the nearer half.
    const unsigned farther = 1u << axis;
    unsigned way[kMaxOctreeDepth];
    int levels = 0;
    const Node* node = cell.node;
    unsigned octant = 0;
    do {
      if (node == cells_.root()) return false;
      octant = cells_.octant(node) ^ path.mirror();
      way[levels++] = octant;
      node = parent(node);
      count.step(), count.event(links_up);
    } while (octant & farther);

    // Go down its farther half by the mirror image of the way up, as far as there are nodes; where cells are not divided
    // alike the ray has to tell the way, but for the first step.
    do {
      octant = way[--levels] ^ farther;
      node = cells_.child(node, octant ^ path.mirror());
      count.step(), count.event(links_down);
    } while (levels > 0 && node->interior() && cells_.divided_alike());
    cell = {cells_.behind(axis, cell, node, levels, path), node};
    return true;
  }

  /// Nodes are stored level by level, the eight children of a node together (octree_build.h).
  std::size_t siblings(const Node* node) const {
    return static_cast<std::size_t>(node - cells_.root() - 1) / 8;
  }
  const Node* parent(const Node* node) const { return cells_.root() + parents_[siblings(node)]; }

  void link_parents() {
    parents_.resize(cells_.nodes().size() / 8);
    for (const Node& node : cells_.nodes())
      if (node.interior())
        parents_[siblings(cells_.child(&node, 0))] = static_cast<std::uint32_t>(&node - cells_.root());
  }

  /// The parent of each eight siblings.
  std::vector<std::uint32_t> parents_;
};

}  // namespace

RAYSHOOT_TECHNIQUE(octree_samet, OctreeSamet)

}  // namespace rayshoot
