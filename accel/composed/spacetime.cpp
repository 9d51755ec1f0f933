// Ray tracing in spacetime: a hierarchy in four dimensions
// A. S. Glassner, "Spacetime ray tracing for animation", IEEE Computer Graphics & Applications 8(2), 1988.
//
// Idea       A moving object is a still one in four dimensions, and a ray is at one time. So volumes bound objects in space
//            during a range of time, and the hierarchy divides times as well as objects: a fork leads a ray to the half of the
//            times that its own is in, where the boxes about the objects' ways are shorter.
// Parameters max_objects (4)         objects a leaf may hold at the most, as bvh_sah
//            max_time_divisions (4)  forks one below the other: sixteen ranges of time at the most, since each doubles what is
//                                    listed below it
//            worthwhile (0.75)       a fork where it leaves no more than this share of the expected tests (equation 2): things
//                                    that move by about their own size, for others a division of the objects gains more
// Cost       equation (3) for the boxes of the ray's range of time; nothing is gained and little lost where nothing moves.
// Weak       turning objects, whose ways are no lines; here parts move along lines alone.

#include <numeric>

#include "accel/core/define_technique.h"
#include "accel/parts/pair_walk.h"
#include "accel/parts/spacetime_tree.h"

namespace rayshoot {

namespace {

template <class Real>
class Spacetime {
 public:
  using Scalar = Real;
  using Config = SpacetimeConfig;
  struct Scratch {};

  static TechniqueInfo info() {
    return {.id = "spacetime",
            .title = "Hierarchy of bounding volumes in space and time",
            .family = "composed",
            .survey_section = "12",
            .paper = "Glassner 1988",
            .parameters = {
                integer_parameter("max_objects", 4, 1, 64, "objects a leaf may hold at the most"),
                integer_parameter("max_time_divisions", 4, 0, 12, "divisions of time at the most"),
                real_parameter("worthwhile", 0.75, 0, 1,
                               "time is divided where that leaves no more than this share of the tests")}};
  }
  static Config configure(const Arguments& arguments) {
    return {.max_objects = static_cast<std::uint32_t>(arguments.integer("max_objects")),
            .max_time_divisions = static_cast<int>(arguments.integer("max_time_divisions")),
            .worthwhile = arguments.real("worthwhile")};
  }

  static Spacetime build(const BuildInput<Real>& in, const Config& config) {
    Spacetime technique;
    technique.tree_ = SpacetimeBuilder<Real>(in.geometry, config).build();
    return technique;
  }

  Scratch scratch() const { return {}; }

  template <class Counter, class L>
  void visit(const Ray<Real>& ray, Scratch&, Counter count, L& leaf) const {
    const auto reach = [&] { return leaf.reach(); };
    walk_pairs(tree_, ray, count, reach, [&](std::uint32_t first, std::uint32_t objects) {
      count.cell(false);
      for (const std::uint32_t object : std::span(tree_.references).subspan(first, objects))
        if (leaf(object)) return true;
      return false;
    });
  }

  StructureStats structure() const {
    return {.nodes = tree_.nodes.size() + tree_.forks.size() + tree_.leaves,
            .leaves = tree_.leaves,
            .references = tree_.references.size(),
            .max_depth = tree_.depth,
            .bytes = tree_.bytes() + tree_.forks.size() * sizeof(tree_.forks[0]) +
                     tree_.references.size() * sizeof(tree_.references[0]),
            .figures = {{"forks", static_cast<double>(tree_.forks.size())}}};
  }

 private:
  SpacetimeTree<Real> tree_;
};

}  // namespace

RAYSHOOT_TECHNIQUE(spacetime, Spacetime)

}  // namespace rayshoot
