// Hierarchy of volumes of various kinds (Arvo & Kirk §4.1 and §4.2)
// H. Weghorst, G. Hooper, D. Greenberg, "Improved computational methods for ray tracing", 1984.
//
// Idea       The modeller's hierarchy, with a volume about every node: a sphere, a box along the axes, a turned box or a
//            cylinder. A tight volume is met by few rays in vain but may be dear to test. Node by node that volume is
//            chosen for which the area that it projects, times the cost of its test, is least.
// Parameters hierarchy    modeller takes the grouping that the scene's generator states, automatic clusters; modeller,
//                         as in the paper; a scene without grouping, as one from a file, is clustered in either case,
//                         and so are the objects or groups of a group that has more than a node may hold
//            resolution   cells of the clustering histogram along the longest axis; 8
//            max_objects  objects that a node may hold itself; 4, since a volume costs about two tests of an object
//            volumes      best chooses; sphere, axis_box, oriented_box or cylinder takes one kind throughout, for
//                         comparison
// Cost       equation (1) at every node: n B + m I, where B is the cost of testing the chosen volume. Projected void
//            area is what differs between volumes about the same objects, whose own projection is the same for all;
//            by Cauchy's theorem the mean projection of a convex volume is a quarter of its surface.
// Weak       groups of the modeller's that overlap or sprawl: he did not build them for rays.
// Exactness  a volume is widened by what a hit may lie beside its surface, ray by ray; a ray that is not finite or of an
//            extreme direction meets every volume but boxes along the axes.

#include "accel/core/define_technique.h"
#include "accel/parts/volume_tree.h"

namespace rayshoot {

namespace {

struct WeghorstConfig {
  HierarchyConfig hierarchy;
  /// The kind of every volume; none to choose.
  std::optional<VolumeKind> kind;
};

template <class Real>
class BvhWeghorst : public VolumeTree<Real> {
  using Tree = VolumeTree<Real>;

 public:
  using Config = WeghorstConfig;
  using Tree::Tree;
  using typename Tree::Scratch;

  static TechniqueInfo info() {
    std::vector<Parameter> parameters = hierarchy_parameters();
    parameters.push_back(volume_kind_parameter());
    return {.id = "bvh_weghorst",
            .title = "Hierarchy of volumes chosen by projected area and cost",
            .family = "bounding_volume",
            .survey_section = "4",
            .paper = "Weghorst, Hooper & Greenberg 1984",
            .parameters = std::move(parameters),
            .events = volume_kind_events()};
  }
  static Config configure(const Arguments& arguments) {
    return {.hierarchy = hierarchy_config(arguments), .kind = volume_kind(arguments)};
  }

  static BvhWeghorst build(const BuildInput<Real>& in, const Config& config) {
    // Choose the volume of each node by itself.
    return BvhWeghorst(in.geometry, object_hierarchy(in.geometry, config.hierarchy),
                       [&](const std::array<Volume<Real>, 4>& volumes) {
                         return config.kind ? volumes[static_cast<std::size_t>(*config.kind)]
                                            : cheapest_volume<Real>(volumes, VolumeFit::projected_area);
                       });
  }

  template <class Counter, class L>
  void visit(const Ray<Real>& ray, Scratch& scratch, Counter count, L& leaf) const {
    const auto tested = [&](VolumeKind kind) { count.event(static_cast<std::size_t>(kind)); };
    this->visit_met(ray, scratch, count, tested, leaf);
  }
};

}  // namespace

RAYSHOOT_TECHNIQUE(bvh_weghorst, BvhWeghorst)

}  // namespace rayshoot
