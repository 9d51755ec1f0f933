// Wide bounding volume hierarchy (the modern reference of Arvo & Kirk §4.3, for one ray and many lanes)
// I. Wald, C. Benthin & S. Boulos, "Getting rid of packets", 2008; the build after H. Ylitie, T. Karras & S. Laine,
// "Efficient incoherent ray traversal on GPUs through compressed wide BVHs", 2017.
//
// Idea       A node has up to eight children, whose boxes are tested at once. A binary tree by the surface area
//            heuristic is widened to the tree of least expected cost that leaving out nodes can make of it, and its
//            small subtrees become leaves of up to eight objects. Where nearly all objects are triangles and the
//            intersector is fast, `closest` and `any` in float are kernels: the triangles of a leaf lie side by side
//            and get the scalar test, operation by operation in double precision, at once.
// Parameters instructions  best takes AVX-512 where the processor has it: eight triangles at once, in AVX2 four
//            mode          single traces ray by ray; batch, where there are kernels, takes many rays at a time: those that
//                          have little in common sorted by where they start and go, where a sample of them takes 3.5
//                          steps or more, for to sort a ray costs as much; coherent ones as they stand, in packets that
//                          part where the rays do, but for any hit, where packets part too soon
//            build         how the binary tree is built: binned, sweep, quality or fast, as bvh_sah's; quality makes
//                          rays up to a twentieth faster in three times the time; fast takes half the time, and its
//                          leaves are clusters, the smallest of which are joined
//            split_budget  slivers, whose boxes are mostly void, are cut into pieces with boxes of their own, so many for
//                          each object of the scene; 5 makes hair up to twice as fast for nine times the memory, and
//                          nothing is cut where rays meet few slivers
//            max_objects   objects a leaf may hold at the most; 8, as many as are tested at once
//            leaf_cost     cost of one test in a leaf, of eight objects where there are kernels, of one otherwise, in
//                          tests of a node's children; 1, and up to 2.5 makes no difference of note
// Order      The nearest child comes first, the others wait sorted by distance. Who looks for any hit takes children as
//            they stand. A kernel looks whether successive rays of its batch run alike: then it guesses the next child
//            by a jump, which is predicted while the boxes are still tested; otherwise it fetches what has to wait.
// Counts     A step is a node, its volume tests are its children, a cell is a leaf. Objects are counted as if tested
//            one after the other: of a leaf all for the nearest hit, those up to the first hit for any. Rays that are
//            not finite, and empty ones, hit nothing and are not looked at.
// Cost       equation (3), exactly, for uniformly distributed rays without occlusion.
// Weak       spheres, cones, and polygons but those of four corners, are tested one by one; single precision alone has
//            kernels, and so has the fast intersector alone. Slivers, where the memory for cutting them is dear.

#include <fmt/format.h>

#include <numeric>

#include "accel/core/define_technique.h"
#include "accel/parts/early_split.h"
#include "accel/parts/ray_order.h"
#include "accel/parts/wide_avx2.h"
#include "accel/parts/wide_build.h"
#include "accel/parts/wide_kernels.h"
#include "accel/parts/wide_walk.h"

namespace rayshoot {

namespace {

template <class Real>
class BvhWide {
 public:
  using Scalar = Real;
  struct Config {
    std::string instructions;
    bool batch;
    SahMethod method;
    double split_budget;
    WideCosts costs;

    /// Clusters of a fast build are not divided; of others every object can be told from every other.
    std::size_t binary_leaf() const { return method == SahMethod::fast ? costs.max_objects : 1; }
  };
  struct Scratch {
    RayOrder order;
  };

  static TechniqueInfo info() {
    return {
        .id = "bvh_wide",
        .title = "Wide bounding volume hierarchy",
        .family = "bounding_volume",
        .survey_section = "4",
        .paper = "Wald, Benthin & Boulos 2008; Ylitie, Karras & Laine 2017",
        .parameters = {
            choice_parameter("instructions", "best", {"best", "avx2"}, "instructions of the timed searches"),
            choice_parameter("mode", "single", {"single", "batch"}, "how rays of a batch are traced"),
            sah_method_parameter(),
            real_parameter("split_budget", 5, 0, 63, "boxes that are spent on slivers, for each object"),
            integer_parameter("max_objects", 8, 1, 8, "objects a leaf may hold at the most"),
            real_parameter("leaf_cost", 1, 0, 100,
                           "cost of testing a leaf's objects, in tests of a node's children")}};
  }
  static Config configure(const Arguments& arguments) {
    return {.instructions = arguments.text("instructions"),
            .batch = arguments.text("mode") == "batch",
            .method = sah_method(arguments),
            .split_budget = arguments.real("split_budget"),
            .costs = {.leaf = arguments.real("leaf_cost"),
                      .max_objects = static_cast<std::uint32_t>(arguments.integer("max_objects"))}};
  }

  static BvhWide build(const BuildInput<Real>& in, const Config& config) {
    if (in.geometry.size() > WideChild::kMostObjects)
      throw InputError(
          fmt::format("bvh_wide: {} objects; {} are possible", in.geometry.size(), WideChild::kMostObjects));
    BvhWide bvh;
    const bool at_once = std::same_as<Real, float> && triangles_suit(in.geometry);
    WideCosts costs = config.costs;
    if (!at_once) costs.objects_at_once = 1;
    HugeVector<BoxedObject<Real>> objects = boxed_objects(in.geometry);
    bvh.margin_ = split_slivers(in.geometry, config.split_budget, objects);
    bvh.tree_ = widened_tree(sah_tree<Real>(objects, {config.method, config.binary_leaf()}), costs);
    bvh.order_ = names_of<Real>(objects);
    if constexpr (std::same_as<Real, float>)
      if (at_once) bvh.triangles_ = WideTriangles(in.geometry, bvh.order_, bvh.tree_);
    bvh.batch_ = config.batch;
    if (config.instructions == "best" && has_avx512()) bvh.kernels_ = &kWideKernelsAvx512;
    return bvh;
  }

  Scratch scratch() const { return {}; }
  std::span<const std::uint32_t> order() const { return order_; }

  template <class Counter, class L>
  void visit(const Ray<Real>& ray, Scratch&, Counter count, L& leaf) const {
    const auto visit_leaf = [&](WideChild which) {
      count.cell(false);
      for (std::uint32_t i = 0; i < which.count(); ++i)
        if (leaf(which.first() + i)) return true;
      return false;
    };
    if (tree_.empty() || !can_hit(ray)) return;
    const WideCrossings<WideAvx2, Real> crossings(PreparedRay(ray), margin_of(ray));
    if constexpr (kSeeksAnyHit<L>)
      walk_wide_unordered<WideAvx2>(tree_, WideChild::interior(0), crossings, count,
                                    static_cast<Real>(leaf.reach()), WideCoherent<WideAvx2>{}, visit_leaf);
    else
      walk_wide<WideAvx2>(
          tree_, WideChild::interior(0), crossings, count, [&] { return leaf.reach(); },
          WideCoherent<WideAvx2>{}, visit_leaf);
  }

  /// Its leaves are the cells of a composition.
  void prepare_cells() {
    positions_.resize(order_.size());
    std::iota(positions_.begin(), positions_.end(), 0u);
  }
  const BvhWide& cells(Scratch&) const { return *this; }
  bool widens_cells() const { return margin_.has_value(); }
  template <class Counter, class Reach, class Visit>
  void visit_cells(const Ray<Real>& ray, Counter count, const Reach& reach, const Visit& visit) const {
    if (tree_.empty() || !can_hit(ray)) return;
    const WideCrossings<WideAvx2, Real> crossings(PreparedRay(ray), margin_of(ray));
    walk_wide<WideAvx2>(
        tree_, WideChild::interior(0), crossings, count, reach, WideCoherent<WideAvx2>{},
        [&](WideChild leaf) { return visit(std::span(positions_).subspan(leaf.first(), leaf.count())); });
  }
  template <class Visit>
  void for_each_cell(const Visit& visit) const {
    tree_.for_each_leaf([&](const Box<Real>& box, WideChild leaf) {
      visit(box, &positions_[leaf.first()], std::span(positions_).subspan(leaf.first(), leaf.count()));
    });
  }

  bool kernels_serve(const Geometry<Real>& geometry) const {
    return std::same_as<Real, float> && triangles_suit(geometry);
  }
  /// Only among many rays there are many alike.
  std::size_t rays_per_batch() const { return batch_ ? std::size_t{1} << 20 : kRaysPerBatch; }
  void kernel_closest(const Geometry<Real>& geometry, std::span<const Ray<Real>> rays,
                      std::span<Hit<Real>> hits, Scratch& scratch) const {
    if constexpr (std::same_as<Real, float>)
      kernels_->closest({tree_, triangles_, geometry, order_, margin_}, batch(geometry, rays, scratch), hits);
  }
  void kernel_any(const Geometry<Real>& geometry, std::span<const Ray<Real>> rays,
                  std::span<std::uint8_t> blocked, Scratch& scratch) const {
    if constexpr (std::same_as<Real, float>)
      kernels_->any({tree_, triangles_, geometry, order_, margin_}, batch(geometry, rays, scratch), blocked);
  }

  StructureStats structure() const {
    StructureStats stats{.nodes = tree_.nodes.size(),
                         .references = order_.size(),
                         .max_depth = tree_.max_depth,
                         .bytes = tree_.bytes() + triangles_.bytes() + order_.size() * sizeof(order_[0])};
    tree_.for_each_leaf([&](const Box<Real>&, WideChild) { ++stats.leaves; });
    stats.nodes += stats.leaves;
    if (!tree_.empty()) {
      Expected expected;
      expect(tree_.nodes[0], 1, expected);
      stats.figures = {{"expected_steps", expected.steps}, {"expected_leaves", expected.leaves}};
    }
    return stats;
  }

  /// Equation (3): a node's children are tested as often as the node is hit, and so are a leaf's objects.
  Prediction<Real> predicted() const {
    Expected expected;
    if (!tree_.empty()) expect(tree_.nodes[0], 1, expected);
    return {expected.object_tests, expected.volume_tests, tree_.bounds};
  }

  /// None where slivers were cut: an object is then in several leaves.
  template <class Visit>
  void for_each_volume(const Visit& visit) const {
    if (!tree_.empty() && !margin_) visit_below(WideChild::interior(0), 0, visit);
  }

 private:
  static constexpr double kStepsWorthSorting = 3.5;

  template <class Visit>
  void visit_below(WideChild child, std::uint32_t depth, const Visit& visit) const {
    if (child.is_leaf())
      return visit(HierarchyVolume{depth, 0, child.count(), child.first(), child.first() + child.count()});
    const WideNode<Real>& node = tree_.nodes[child.node()];
    visit(HierarchyVolume{.depth = depth, .volume_tests = node.children});
    for (std::uint32_t which = 0; which < node.children; ++which)
      visit_below(node.child[which], depth + 1, visit);
  }

  using PreparedRay = std::conditional_t<std::same_as<Real, float>, WideRay<WideAvx2>, Ray<double>>;

  /// Whether the ray's origin and direction are finite, and its interval holds a number: no other hits anything.
  static bool can_hit(const Ray<Real>& ray) {
    const Vec3<Real> zero = (ray.origin - ray.origin) + (ray.direction - ray.direction);
    return (zero == Vec3<Real>{}) & (ray.t_min < ray.t_max);
  }
  /// Rays that have little in common are sorted, where they are all there are and search for long.
  WideBatch batch(const Geometry<float>& geometry, std::span<const Ray<float>> rays, Scratch& scratch) const {
    if (const bool coherent = are_coherent(rays); coherent || !batch_)
      // Margins are for single rays.
      return {.rays = rays, .coherent = coherent, .in_packets = coherent && batch_ && !margin_};
    if (steps_of_some(geometry, rays) < kStepsWorthSorting) return {.rays = rays};
    return {.rays = rays, .order = scratch.order.sorted(rays, tree_.bounds), .coherent = true};
  }
  /// Steps of the mean ray to its nearest hit, of 64 rays or so.
  double steps_of_some(const Geometry<float>& geometry, std::span<const Ray<float>> rays) const {
    const auto test = [&](std::uint32_t position, const Ray<float>& ray) {
      return geometry.hit_distance(order_[position], ray);
    };
    Work work;
    Scratch none;
    for (std::size_t i = 0; i < rays.size(); i += std::max<std::size_t>(rays.size() / 64, 1), ++work.rays) {
      ClosestLeaf<float, decltype(test)> leaf(test, {order_.data()}, rays[i]);
      visit(rays[i], none, Count(work), leaf);
    }
    return static_cast<double>(work.steps) / static_cast<double>(work.rays);
  }
  Real margin_of(const Ray<Real>& ray) const { return margin_ ? box_margin(*margin_, ray) : 0; }
  static bool triangles_suit(const Geometry<Real>& geometry) {
    return geometry.mostly_triangles() && geometry.intersector() == Intersector::fast;
  }

  /// What is expected of a ray that hits the root's box, occlusion neglected.
  struct Expected {
    double steps = 0, leaves = 0, object_tests = 0, volume_tests = 0;
  };
  void expect(const WideNode<Real>& node, double probability, Expected& sum) const {
    sum.steps += probability;
    sum.volume_tests += probability * node.children;
    for (std::uint32_t which = 0; which < node.children; ++which) {
      const WideChild child = node.child[which];
      const double of_child = node.box(which).surface_area() / tree_.bounds.surface_area();
      if (child.is_leaf())
        sum.leaves += of_child, sum.object_tests += of_child * child.count();
      else
        expect(tree_.nodes[child.node()], of_child, sum);
    }
  }

  WideTree<Real> tree_;
  WideTriangles triangles_;
  std::vector<std::uint32_t> order_;
  /// Where slivers were cut: by how much boxes must grow for some rays.
  std::optional<SurfaceMargin<Real>> margin_;
  /// All positions in turn, in a composition alone.
  std::vector<std::uint32_t> positions_;
  bool batch_ = false;
  const WideKernels* kernels_ = &kWideKernelsAvx2;
};

}  // namespace

RAYSHOOT_TECHNIQUE(bvh_wide, BvhWide)

}  // namespace rayshoot
