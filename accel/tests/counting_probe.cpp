// What no_counting_overhead_test runs under callgrind: a search for the nearest hits of the same rays by
//   probe_timed        a technique's engine, as it is timed
//   probe_counted      the same, counting
//   probe_uncountable  an engine around the same algorithm written by hand, without a counter policy
//   probe_plain        that algorithm in a plain loop, without an engine
// Usage: counting_probe exhaustive|bvh_sah

#include <functional>

#include "accel/core/define_technique.h"
#include "accel/core/registry.h"
#include "accel/parts/branch.h"
#include "accel/parts/sah_build.h"
#include "scenes/io/load_scene.h"

using namespace rayshoot;

namespace {

using Rays = std::span<const Ray<float>>;
using Hits = std::span<Hit<float>>;

/// What both searches by hand need to stand behind an engine.
struct ByHand {
  using Scalar = float;
  struct Config {};
  struct Scratch {};

  static TechniqueInfo info() { return {}; }
  static Config configure(const Arguments&) { return {}; }
  Scratch scratch() const { return {}; }
  StructureStats structure() const { return {}; }
};

/// Exhaustive search, with no counter anywhere.
class AllObjects : public ByHand {
 public:
  static AllObjects build(const BuildInput<float>& in, const Config&) {
    AllObjects all;
    all.objects_ = in.geometry.size();
    return all;
  }

  template <class Ignored, class L>
  void visit(const Ray<float>&, Scratch&, Ignored, L& leaf) const {
    for (std::uint32_t object = 0; object < objects_; ++object)
      if (leaf(object)) return;
  }

 private:
  std::uint32_t objects_ = 0;
};

/// A bounding volume hierarchy over the tree that bvh_sah builds, with no counter anywhere.
class Tree : public ByHand {
 public:
  static Tree build(const BuildInput<float>& in, const Config&) {
    Tree tree;
    tree.bounds_ = in.geometry.bounds();
    HugeVector<BoxedObject<float>> objects = boxed_objects(in.geometry);
    PairTree<float> pairs = sah_tree<float>(objects, {});
    tree.root_ = pairs.root;
    tree.nodes_ = std::move(pairs.nodes);
    tree.order_ = names_of<float>(objects);
    return tree;
  }

  std::span<const std::uint32_t> order() const { return order_; }

  template <class Ignored, class L>
  void visit(const Ray<float>& ray, Scratch&, Ignored, L& leaf) const {
    if (order_.empty()) return;
    const Interval<float> whole = Crossings<float>(ray).inside(bounds_);
    if (!(std::max(whole.enter, ray.t_min) <= std::min(whole.exit, ray.t_max))) return;
    struct Postponed {
      ChildReference child;
      float enter;
    };
    Postponed stack[kMaxSahDepth];
    int postponed = 0;
    const PairCrossings<float> crossings(ray);
    ChildReference current = root_;
    while (true) {
      if (current.leaf()) {
        for (std::uint32_t i = 0; i < current.count; ++i)
          if (leaf(current.first + i)) return;
      } else {
        const PairNode<float>& node = nodes_[current.first];
        __builtin_prefetch(nodes_.data() + node.child[0].first);
        __builtin_prefetch(nodes_.data() + node.child[1].first);
        const float reach = leaf.reach();
        const Lanes<float> inside =
            crossings.inside(node.boxes, Lanes<float>{ray.t_min, ray.t_min, -reach, -reach});
        const bool first = inside[0] <= -inside[2], second = inside[1] <= -inside[3];
        if (first && second) {
          if (inside[1] < inside[0]) {
            keep_branch();
            stack[postponed++] = {node.child[0], inside[0]};
            current = node.child[1];
          } else {
            keep_branch();
            stack[postponed++] = {node.child[1], inside[1]};
            current = node.child[0];
          }
          continue;
        }
        if (first) {
          keep_branch();
          current = node.child[0];
          continue;
        }
        if (second) {
          keep_branch();
          current = node.child[1];
          continue;
        }
      }
      do {
        if (postponed == 0) return;
        --postponed;
      } while (stack[postponed].enter > leaf.reach());
      current = stack[postponed].child;
    }
  }

 private:
  HugeVector<PairNode<float>> nodes_;
  std::vector<std::uint32_t> order_;
  ChildReference root_{};
  Box<float> bounds_;
};

/// The loop over rays by hand, too.
template <class A>
[[gnu::flatten, gnu::noinline]] void plain_loop(const A& search, const Geometry<float>& geometry, Naming name,
                                                Rays rays, Hits hits) {
  using Test = TriangleTest<float, Intersector::fast>;
  const Test test{geometry};
  ByHand::Scratch scratch;
  for (std::size_t i = 0; i < rays.size(); ++i) {
    ClosestLeaf<float, Test> leaf(test, name, rays[i]);
    search.visit(rays[i], scratch, nullptr, leaf);
    hits[i] = leaf.hit();
  }
}

}  // namespace

// The functions that are watched: alike, and yet to be told apart.
using Loop = std::function<void()>;
extern "C" {
[[gnu::noinline, gnu::no_icf]] void probe_timed(const Loop& loop) { loop(); }
[[gnu::noinline, gnu::no_icf]] void probe_counted(const Loop& loop) { loop(); }
[[gnu::noinline, gnu::no_icf]] void probe_uncountable(const Loop& loop) { loop(); }
[[gnu::noinline, gnu::no_icf]] void probe_plain(const Loop& loop) { loop(); }
}

namespace {

/// Search by the technique `id` and by `A`, which is the same by hand; whether all found the same hits.
template <class A>
bool probe(const std::string& id, std::uint32_t ray_count) {
  // Lines between corners of the bounds of objects.
  const Geometry<float> geometry(load_scene("balls:2/patches").scene);
  std::vector<Ray<float>> rays;
  for (std::uint32_t i = 0; i < ray_count; ++i) {
    const Vec3<float> from = geometry.bounds(i * 7919 % geometry.size()).hi * 2;
    rays.push_back({.origin = from, .direction = geometry.bounds(i * 104729 % geometry.size()).lo - from});
  }

  const TechniqueEntry& entry = technique_entry(id);
  const Arguments defaults(entry.info.parameters, {}, id);
  const auto engine = entry.build<float>({geometry, defaults});
  const TechniqueEngine<A> uncountable({geometry, defaults});
  const A search = A::build({geometry}, {});
  Naming name;
  Geometry<float> arranged = geometry;
  if constexpr (OrdersObjects<A>) {
    name = {search.order().data()};
    arranged = geometry.arranged(search.order());
  }

  std::vector<Hit<float>> timed(rays.size()), counted = timed, without = timed, plain = timed;
  const auto scratch = engine->scratch(), uncountable_scratch = uncountable.scratch();
  probe_timed([&] { engine->closest(rays, timed, *scratch); });
  probe_counted([&] { engine->count(Query::closest, rays, counted, *scratch); });
  probe_uncountable([&] { uncountable.closest(rays, without, *uncountable_scratch); });
  probe_plain([&] { plain_loop(search, arranged, name, rays, plain); });
  return timed == plain && counted == plain && without == plain &&
         plain != std::vector<Hit<float>>(rays.size());
}

}  // namespace

int main(int count, char** arguments) {
  const std::string id = count == 2 ? arguments[1] : "";
  if (id == "exhaustive") return probe<AllObjects>(id, 20) ? 0 : 1;
  if (id == "bvh_sah") return probe<Tree>(id, 3000) ? 0 : 1;
  return 2;
}
