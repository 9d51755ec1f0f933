// Hierarchy of boxes in frames of their own (Arvo & Kirk §4.2)
// S. Rubin, T. Whitted, "A 3-dimensional representation for fast rendering of complex scenes", 1980.
//
// Idea       Bound everything by boxes, turned so that they fit: a ray is transformed into the frame of a box, where
//            its test is that of an axis-aligned box. The boxes form a hierarchy, which the modeller built, structured
//            object by structured object; or objects are clustered about the densest peaks of a 3-D histogram of their
//            centres. A ray that misses a box is done with all that is below it.
// Parameters hierarchy    modeller takes the grouping that the scene's generator states, automatic clusters; modeller,
//                         as in the paper; a scene without grouping, as one from a file, is clustered in either case,
//                         and so are the objects or groups of a group that has more than a node may hold
//            resolution   cells of the histogram along the longest axis; 8, of which not more are used than there are
//                         objects
//            max_objects  objects that a node may hold itself; 4, since a box costs about two tests of an object
//            orientation  principal turns a box along the principal axes of its objects' vertices where it is smaller
//                         so, axis_aligned never
// Cost       a transformation of the ray for every turned box tested, counted as `ray_transforms`.
// Weak       groups of the modeller's that overlap or sprawl: he did not build them for rays.
// Exactness  a turned box is widened by what a hit may lie beside its surface, ray by ray; a ray that is not finite or
//            of an extreme direction meets every turned box.

#include "accel/core/define_technique.h"
#include "accel/parts/volume_tree.h"

namespace rayshoot {

namespace {

struct RubinWhittedConfig {
  HierarchyConfig hierarchy;
  bool turned = true;
};

template <class Real>
class BvhRubinWhitted : public VolumeTree<Real> {
  using Tree = VolumeTree<Real>;

 public:
  using Config = RubinWhittedConfig;
  using Tree::Tree;
  using typename Tree::Scratch;

  static TechniqueInfo info() {
    std::vector<Parameter> parameters = hierarchy_parameters();
    parameters.push_back(choice_parameter("orientation", "principal", {"principal", "axis_aligned"},
                                          "whether boxes are turned along their objects' principal axes"));
    return {.id = "bvh_rubin_whitted",
            .title = "Hierarchy of boxes in frames of their own",
            .family = "bounding_volume",
            .survey_section = "4",
            .paper = "Rubin & Whitted 1980",
            .parameters = std::move(parameters),
            .events = {"ray_transforms"}};
  }
  static Config configure(const Arguments& arguments) {
    return {hierarchy_config(arguments), arguments.text("orientation") == "principal"};
  }

  static BvhRubinWhitted build(const BuildInput<Real>& in, const Config& config) {
    // Turn a box where it has less surface so.
    return BvhRubinWhitted(in.geometry, object_hierarchy(in.geometry, config.hierarchy),
                           [&](const std::array<Volume<Real>, 4>& volumes) {
                             const auto& straight = volumes[static_cast<int>(VolumeKind::axis_box)];
                             const auto& turned = volumes[static_cast<int>(VolumeKind::oriented_box)];
                             const bool smaller = turned.surface_area() < straight.surface_area();
                             return config.turned && smaller ? turned : straight;
                           });
  }

  /// Transform the ray once into the frame of each turned box that is tested.
  template <class Counter, class L>
  void visit(const Ray<Real>& ray, Scratch& scratch, Counter count, L& leaf) const {
    const auto tested = [&](VolumeKind kind) {
      if (kind == VolumeKind::oriented_box) count.event(0);
    };
    this->visit_met(ray, scratch, count, tested, leaf);
  }
};

}  // namespace

RAYSHOOT_TECHNIQUE(bvh_rubin_whitted, BvhRubinWhitted)

}  // namespace rayshoot
