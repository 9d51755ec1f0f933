// k-d tree by the surface area heuristic (the modern form of Arvo & Kirk §5.1's binary space partitioning)
// J. MacDonald, K. Booth, "Heuristics for ray tracing using space subdivision", 1989; I. Wald, V. Havran, "On building
// fast kd-trees for ray tracing, and on doing that in O(N log N)", 2006.
//
// Idea       Divide the box of the scene by a plane, again and again, where equation (3) expects the least cost: only
//            planes at which the bounds of some object end come into question. A plane that cuts empty space off gets a
//            bonus. A ray is clipped at the planes it crosses and visits the leaves near to far.
// Parameters traversal_cost     of a step, in units where a ray-object test costs intersection_cost: 1
//            intersection_cost  0.25: a step waits for memory, while the objects of a leaf are tested one after the other;
//                               theirs, 20 to 15, takes longer on every scene tried, two to three times as long to build
//                               and as much memory
//            empty_bonus        share of its cost that a plane is forgiven for cutting off empty space: 0.2, theirs
//            max_depth          0: 8 + 1.3 log2 n (Pharr & Humphreys 2004), before which the heuristic mostly ends
//            clipped            on: an object counts, and is listed, where the part of its surface inside a cell reaches
//                               ("perfect splits"); off: wherever its bounds do, which builds several times as fast and
//                               tests more, several times as many objects where triangles are long and thin
//            mailbox            auto: where an object is listed twice
// Cost       equation (3) with planes: the surface of a child over that of its cell is the chance that a ray that comes
//            into the cell comes into the child.
// Weak       objects that are cut by many planes; a build of half a second for every hundred thousand triangles or so.
//
// Exactness  Which side of a plane an object is on, and a ray's crossing of it, come from the same stored number, and the
//            crossing has an earliest and a latest parameter: a hit lies in a leaf that lists its object.

#include "accel/core/define_technique.h"
#include "accel/parts/kd_build.h"
#include "accel/parts/surface_margin.h"
#include "accel/parts/visit_cells.h"

namespace rayshoot {

namespace {

struct KdTreeConfig {
  KdRules rules;
  MailboxUse mailbox = MailboxUse::automatic;
};

template <class Real>
class KdTree {
 public:
  using Scalar = Real;
  using Config = KdTreeConfig;
  using Scratch = Mailbox;

  static TechniqueInfo info() {
    constexpr KdRules defaults;
    return {.id = "kd_tree",
            .title = "k-d tree by the surface area heuristic",
            .family = "bsp",
            .survey_section = "5.1",
            .paper = "MacDonald & Booth 1989; Wald & Havran 2006",
            .parameters = {
                real_parameter("traversal_cost", defaults.traversal_cost, 0, 1000, "cost of a step"),
                real_parameter("intersection_cost", defaults.intersection_cost, 1e-3, 1000,
                               "cost of a ray-object test"),
                real_parameter("empty_bonus", defaults.empty_bonus, 0, 0.99,
                               "share of the cost of a plane that cuts off empty space"),
                integer_parameter("max_depth", 0, 0, kMaxAxisTreeDepth - 1,
                                  "divisions above a leaf at the most; 0: 8 + 1.3 log2 n"),
                boolean_parameter("clipped", true, "count objects where the part inside a cell reaches"),
                mailbox_parameter()}};
  }
  static Config configure(const Arguments& arguments) {
    return {.rules = {.traversal_cost = arguments.real("traversal_cost"),
                      .intersection_cost = arguments.real("intersection_cost"),
                      .empty_bonus = arguments.real("empty_bonus"),
                      .max_depth = static_cast<int>(arguments.integer("max_depth")),
                      .clipped = arguments.boolean("clipped")},
            .mailbox = mailbox_use(arguments)};
  }

  static KdTree build(const BuildInput<Real>& in, const Config& config) {
    KdTree technique;
    const std::uint32_t objects = in.geometry.size();
    if (config.rules.clipped) technique.margin_ = SurfaceMargin<Real>(in.geometry.bounds());
    technique.tree_ =
        build_kd_tree(in.geometry, config.rules, technique.margin_ ? technique.margin_->of_cells() : Real{0});
    technique.order_objects(objects);
    if (wants_mailbox(config.mailbox, technique.tree_.references.size(), objects))
      technique.mailboxes_ = objects;
    return technique;
  }

  Scratch scratch() const { return Mailbox(mailboxes_); }
  std::span<const std::uint32_t> order() const { return order_; }

  StructureStats structure() const {
    StructureStats stats = tree_.structure();
    stats.bytes += order_.size() * sizeof(order_[0]);
    return stats;
  }

  template <class Counter, class L>
  void visit(const Ray<Real>& ray, Scratch& mailbox, Counter count, L& leaf) const {
    visit_objects_of_cells(*this, ray, mailbox, count, leaf);
  }

  template <class Counter, class Reach, class Visit>
  void visit_cells(const Ray<Real>& ray, Counter count, const Reach& reach, const Visit& visit) const {
    if (const Real margin = margin_ ? margin_->of_ray(ray) : 0; margin != 0) [[unlikely]]
      return visit_within(margin, ray, count, reach, visit);
    walk_clipped<false>(tree_, AxisTreeRay<Real>(ray), ray.t_min, count, reach,
                        [&](const auto& leaf) { return visit(tree_.objects(leaf)); });
  }

  const KdTree& cells(Scratch&) const { return *this; }
  bool widens_cells() const { return margin_.has_value(); }
  template <class Visit>
  void for_each_cell(const Visit& visit) const {
    tree_.for_each_cell(visit);
  }

 private:
  /// For rays too far away for the margin of clipped surfaces, all planes are as thick as theirs.
  template <class Counter, class Reach, class Visit>
  [[gnu::noinline, gnu::cold]] void visit_within(Real margin, const Ray<Real>& ray, Counter count,
                                                 const Reach& reach, const Visit& visit) const {
    walk_clipped<true>(tree_, AxisTreeRay<Real>(ray, margin), ray.t_min, count, reach,
                       [&](const auto& leaf) { return visit(tree_.objects(leaf)); });
  }

  /// Lay objects out in the order in which the leaves list them first, so that those of a leaf lie close together.
  void order_objects(std::uint32_t objects) {
    std::vector<std::uint32_t> position(objects, kNoObject);
    const auto place = [&](std::uint32_t object) {
      if (position[object] != kNoObject) return;
      position[object] = static_cast<std::uint32_t>(order_.size());
      order_.push_back(object);
    };
    order_.reserve(objects);
    for (const std::uint32_t object : tree_.references) place(object);
    for (std::uint32_t object = 0; object < objects; ++object) place(object);
    for (std::uint32_t& reference : tree_.references) reference = position[reference];
  }

  AxisTree<Real> tree_;
  std::vector<std::uint32_t> order_;
  /// Set where objects are clipped.
  std::optional<SurfaceMargin<Real>> margin_;
  std::uint32_t mailboxes_ = 0;
};

}  // namespace

RAYSHOOT_TECHNIQUE(kd_tree, KdTree)

}  // namespace rayshoot
