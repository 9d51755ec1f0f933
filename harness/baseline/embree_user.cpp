// Embree's tree over our objects (Embree 3, user geometry)
//
// Idea       Embree builds and traverses its hierarchy and calls back with every candidate that it finds; the
//            ray-object test and the rule for ties are ours. So its hits equal those of exhaustive search
//            with ==, and its candidates can be counted like those of any technique.
// Parameters quality    low builds along a Morton curve, medium by the surface area heuristic over bins. High
//                       would add spatial splits, which Embree does not apply to user geometry.
// Cost       equation (3) over a tree that Embree does not show; of the counts, it has object tests alone.
// Weak       two indirect calls for each candidate; `embree` shows what the tree does without them. Rays from
//            more than 7 scenes away take a second tree, of quality low, from more than 511 none.
//
// Exactness  Embree only culls, and must cull nothing that could matter. It does not cross planes as we do,
//            and has no robust mode for user geometry. Therefore:
//            1. It sees the scene scaled to coordinates below 1, and directions scaled to a largest component
//               of 1 to 2, by powers of two that leave every mantissa alone.
//            2. From an origin with coordinates up to r, in scenes, we cross planes up to 3 (r + 1) off, and
//               Embree 6 (r + 1), which also rounds the distances of postponed nodes by 16 (r + 1), all times
//               2^-24. So boxes are padded by 32 (r + 1) of these; one tree has r = 7, the other 511. That
//               also hides that Embree takes components of a direction below 1e-18 for 1e-18.
//            Rays from farther away, and those that are not finite or so slow or fast that numbers run out,
//            are tested against every object.

#include <bit>
#include <cmath>

#include "accel/core/define_technique.h"
#include "harness/baseline/baselines.h"
#include "harness/baseline/embree_scene.h"

namespace rayshoot {

namespace {

constexpr float kInfinity = std::numeric_limits<float>::infinity();
constexpr float kSlowest = 0x1p-100f, kFastest = 0x1p100f;  // for directions as given and in scenes

/// The largest power of two not above a normal number.
float power_of_two_below(float x) {
  return std::bit_cast<float>(std::bit_cast<std::uint32_t>(x) & 0x7F800000u);
}

/// Embree's tree over the scene in a frame of its own, for rays with origins up to `farthest` scenes away.
class Tree {
 public:
  Tree(const Geometry<float>& geometry, RTCBuildQuality quality, float farthest, RTCIntersectFunctionN offer)
      : scale_(scale(geometry.bounds())), farthest_(farthest / scale_), padding_(0x1p-19f * (farthest + 1)) {
    EmbreeGeometry objects(RTC_GEOMETRY_TYPE_USER);
    BoundsSource source{geometry, *this};
    rtcSetGeometryUserPrimitiveCount(objects.get(), geometry.size());
    rtcSetGeometryUserData(objects.get(), &source);
    rtcSetGeometryBoundsFunction(objects.get(), BoundsSource::answer, nullptr);
    rtcSetGeometryIntersectFunction(objects.get(), offer);
    scene_ = std::make_unique<EmbreeScene>(quality, false);
    scene_->attach(objects, 0);
    scene_->build();
  }

  /// Whether this tree may be trusted with the ray.
  bool holds(const Ray<float>& ray) const {
    const Vec3<float>&o = ray.origin, &d = ray.direction;
    const float fastest = std::min(kFastest, kFastest / scale_);
    const auto within = [](const Vec3<float>& v, float limit) {
      return (std::abs(v.x) <= limit) & (std::abs(v.y) <= limit) & (std::abs(v.z) <= limit);
    };
    const bool ends = (ray.t_min >= 0) & (ray.t_max <= std::numeric_limits<float>::max());
    return within(o, farthest_) && within(d, fastest) && ends && max_abs(d) >= kSlowest;
  }

  RTCScene scene() const { return scene_->get(); }
  /// What a coordinate is multiplied with.
  float scale() const { return scale_; }
  std::uint64_t bytes() const { return scene_->bytes(); }

 private:
  struct BoundsSource {
    const Geometry<float>& geometry;
    const Tree& tree;

    static void answer(const RTCBoundsFunctionArguments* arguments) {
      const auto& source = *static_cast<const BoundsSource*>(arguments->geometryUserPtr);
      *arguments->bounds_o = source.tree.padded(source.geometry.bounds(arguments->primID));
    }
  };

  static float scale(const Box<float>& bounds) {
    const float size = std::max(max_abs(bounds.lo), max_abs(bounds.hi));
    return 0.5f / power_of_two_below(std::clamp(size, kSlowest, kFastest));
  }

  RTCBounds padded(const Box<float>& box) const {
    const Vec3<float> padding{padding_, padding_, padding_};
    const Vec3<float> lo = box.lo * scale_ - padding, hi = box.hi * scale_ + padding;
    return {lo.x, lo.y, lo.z, 0, hi.x, hi.y, hi.z, 0};
  }

  float scale_, farthest_, padding_;
  std::unique_ptr<EmbreeScene> scene_;
};

/// One ray on its way through a tree; the callback finds it through the context that Embree hands on.
class Search : public RTCIntersectContext {
 public:
  void run() { rtcIntersect1(scene_, this, &hit_); }

  /// Embree's callback with one candidate.
  static void candidate(const RTCIntersectFunctionNArguments* arguments) {
    auto& search = static_cast<Search&>(*arguments->context);
    search.hit_.ray.tfar = search.offer_(search, arguments->primID);
  }

 protected:
  /// `offer` gives an object to the query and returns where Embree's ray ends from then on.
  using Offer = float (*)(Search& search, std::uint32_t object);

  Search(const Tree& tree, const Ray<float>& ray, Offer offer) : scene_(tree.scene()), offer_(offer) {
    const float speed = power_of_two_below(max_abs(ray.direction));
    stretch_ = double{tree.scale()} * speed;
    const Vec3<float> origin = ray.origin * tree.scale(), direction = ray.direction * (1 / speed);
    rtcInitIntersectContext(this);
    hit_.ray = {.org_x = origin.x,
                .org_y = origin.y,
                .org_z = origin.z,
                .tnear = distance(ray.t_min),
                .dir_x = direction.x,
                .dir_y = direction.y,
                .dir_z = direction.z,
                .time = 0,
                .tfar = end(ray.t_max),
                .mask = ~0u,
                .id = 0,
                .flags = 0};
    hit_.hit.geomID = RTC_INVALID_GEOMETRY_ID;
  }

  /// Where Embree's ray must end to keep everything up to our distance `reach`; not so near to zero that
  /// Embree's rounding matters.
  float end(float reach) const { return std::max(distance(reach), std::numeric_limits<float>::min()); }

 private:
  /// Our distance in Embree's frame.
  float distance(double t) const {
    return static_cast<float>(std::min(t * stretch_, double{std::numeric_limits<float>::max()}));
  }

  RTCRayHit hit_;
  RTCScene scene_;
  Offer offer_;
  double stretch_;
};

/// A search that gives its candidates to a leaf.
template <class L>
class LeafSearch final : public Search {
 public:
  LeafSearch(const Tree& tree, const Ray<float>& ray, L& leaf) : Search(tree, ray, offer), leaf_(leaf) {}

 private:
  /// Once the query is answered Embree's ray ends before its start, which ends the traversal.
  static float offer(Search& base, std::uint32_t object) {
    auto& search = static_cast<LeafSearch&>(base);
    search.answered_ = search.answered_ || search.leaf_(object);
    return search.answered_ ? -kInfinity : search.end(search.leaf_.reach());
  }

  L& leaf_;
  bool answered_ = false;
};

class EmbreeUser {
 public:
  using Scalar = float;
  struct Config {
    RTCBuildQuality quality = RTC_BUILD_QUALITY_MEDIUM;
  };
  struct Scratch {};

  static TechniqueInfo info() {
    return {
        .id = "embree_user",
        .title = "Embree's tree over our objects",
        .family = "baseline",
        .survey_section = "4",
        .paper = "Wald, Woop, Benthin, Johnson & Ernst 2014",
        .parameters = {choice_parameter("quality", "medium", {"low", "medium"}, "Embree's build quality")},
        .baseline = true};
  }
  static Config configure(const Arguments& arguments) {
    return {arguments.text("quality") == "low" ? RTC_BUILD_QUALITY_LOW : RTC_BUILD_QUALITY_MEDIUM};
  }
  static EmbreeUser build(const BuildInput<float>& in, const Config& config) {
    return {Tree(in.geometry, config.quality, 7, Search::candidate),
            Tree(in.geometry, RTC_BUILD_QUALITY_LOW, 511, Search::candidate), in.geometry.size()};
  }

  Scratch scratch() const { return {}; }

  /// Let Embree find the candidates; offer every object to a ray that Embree might treat wrongly.
  template <class Counter, class L>
  void visit(const Ray<float>& ray, Scratch&, Counter, L& leaf) const {
    if (near_.holds(ray)) return LeafSearch<L>(near_, ray, leaf).run();
    if (far_.holds(ray)) return LeafSearch<L>(far_, ray, leaf).run();
    for (std::uint32_t object = 0; object < objects_; ++object)
      if (leaf(object)) return;
  }

  StructureStats structure() const { return {.bytes = near_.bytes() + far_.bytes()}; }

 private:
  EmbreeUser(Tree near, Tree far, std::uint32_t objects)
      : near_(std::move(near)), far_(std::move(far)), objects_(objects) {}

  Tree near_, far_;
  std::uint32_t objects_;
};

}  // namespace

const TechniqueEntry& baseline_embree_user() {
  static const TechniqueEntry entry{
      .info = EmbreeUser::info(),
      .build_float = [](const EngineInput<float>& input) -> std::unique_ptr<Engine<float>> {
        return std::make_unique<TechniqueEngine<EmbreeUser>>(input);
      }};
  return entry;
}

}  // namespace rayshoot
