// Embree (Wald, Woop, Benthin, Johnson & Ernst 2014; Embree 3)
//
// Idea       What a practitioner would use instead: Embree's hierarchy with Embree's own ray-triangle test.
//            Polygons are cut into triangles; spheres are Embree's points; cones are user geometry with our
//            test, since Embree's own cones have caps. Its distances differ from ours in the last digits and
//            its choice between equal ones is open, so it is graded and not held to ==.
// Parameters quality         low builds along a Morton curve, medium by the surface area heuristic over bins,
//                            high with spatial splits, which rarely pay
//            robust          watertight triangles and conservative boxes, 10 to 25 % slower
//            mode            single traces ray by ray; stream hands over 256 rays at a time, which pays where
//                            neighbours are alike
//            coherent        tells Embree that the rays of a stream are alike
//            spheres         native, or user: our sphere test behind a callback
//            flush_to_zero   trace with denormal numbers taken as zero, as Embree advises; off as everywhere
// Cost       not known: Embree does not count. About 64 bytes a triangle.
// Weak       long thin triangles in many directions, such as hair. Objects beyond 1.8e18 are invisible to it.
//            It aborts on rays that are not finite, so these miss without asking it. A native sphere that a
//            ray starts on exactly may be hit at t_min.

#include <array>
#include <stdexcept>

#include "accel/core/engine.h"
#include "harness/baseline/baselines.h"
#include "harness/baseline/denormals.h"
#include "harness/baseline/embree_objects.h"

namespace rayshoot {

namespace {

constexpr std::size_t kStreamRays = 256;

struct EmbreeConfig {
  RTCBuildQuality quality;
  bool robust, stream, coherent, native_spheres, flush_to_zero;

  explicit EmbreeConfig(const Arguments& arguments)
      : robust(arguments.boolean("robust")),
        stream(arguments.text("mode") == "stream"),
        coherent(arguments.boolean("coherent")),
        native_spheres(arguments.text("spheres") == "native"),
        flush_to_zero(arguments.boolean("flush_to_zero")) {
    const std::string& name = arguments.text("quality");
    quality = name == "low"    ? RTC_BUILD_QUALITY_LOW
              : name == "high" ? RTC_BUILD_QUALITY_HIGH
                               : RTC_BUILD_QUALITY_MEDIUM;
    if (coherent && !stream) throw InputError("embree: coherent=on needs mode=stream");
  }
};

/// Whether Embree takes the ray: it aborts on numbers that are not finite or too large, and on a negative
/// t_min.
bool acceptable(const Ray<float>& ray) {
  const auto bounded = [](const Vec3<float>& v) {
    return (std::abs(v.x) <= kEmbreeLargest) & (std::abs(v.y) <= kEmbreeLargest) &
           (std::abs(v.z) <= kEmbreeLargest);
  };
  return bounded(ray.origin) & bounded(ray.direction) & (ray.t_min >= 0) & (ray.t_max > ray.t_min);
}

/// The ray for Embree; one that Embree passes over where it would not take the ray.
RTCRay embree_ray(const Ray<float>& ray) {
  const Vec3<float>&o = ray.origin, &d = ray.direction;
  if (!acceptable(ray)) return {.tnear = 1, .dir_x = 1, .tfar = 0};
  return {.org_x = o.x,
          .org_y = o.y,
          .org_z = o.z,
          .tnear = ray.t_min,
          .dir_x = d.x,
          .dir_y = d.y,
          .dir_z = d.z,
          .time = 0,
          .tfar = ray.t_max,
          .mask = ~0u,
          .id = 0,
          .flags = 0};
}

/// Embree ends a ray that is blocked before its start.
bool is_blocked(const RTCRay& traced) { return traced.tfar == -std::numeric_limits<float>::infinity(); }

class EmbreeEngine final : public Engine<float> {
 public:
  explicit EmbreeEngine(const EngineInput<float>& input)
      : config_(input.arguments),
        scene_(config_.quality, config_.robust),
        objects_(input.geometry, config_.native_spheres, scene_) {
    scene_.build();
  }

  std::unique_ptr<EngineScratch> scratch() const override { return std::make_unique<Scratch>(); }

  void closest(std::span<const Ray<float>> rays, std::span<Hit<float>> hits,
               EngineScratch& scratch) const override {
    auto& traced = static_cast<Scratch&>(scratch).hits;
    RTCIntersectContext context = new_context();
    const FlushToZero flush(config_.flush_to_zero);
    for_streams(rays.size(), [&](std::size_t first, unsigned count) {
      for (unsigned i = 0; i < count; ++i) {
        traced[i].ray = embree_ray(rays[first + i]);
        traced[i].hit.geomID = RTC_INVALID_GEOMETRY_ID;
      }
      if (config_.stream)
        rtcIntersect1M(scene_.get(), &context, traced.data(), count, sizeof(RTCRayHit));
      else
        rtcIntersect1(scene_.get(), &context, traced.data());
      for (unsigned i = 0; i < count; ++i) hits[first + i] = hit_of(traced[i]);
    });
  }

  void any(std::span<const Ray<float>> rays, std::span<std::uint8_t> blocked,
           EngineScratch& scratch) const override {
    auto& traced = static_cast<Scratch&>(scratch).rays;
    RTCIntersectContext context = new_context();
    const FlushToZero flush(config_.flush_to_zero);
    for_streams(rays.size(), [&](std::size_t first, unsigned count) {
      for (unsigned i = 0; i < count; ++i) traced[i] = embree_ray(rays[first + i]);
      if (config_.stream)
        rtcOccluded1M(scene_.get(), &context, traced.data(), count, sizeof(RTCRay));
      else
        rtcOccluded1(scene_.get(), &context, traced.data());
      for (unsigned i = 0; i < count; ++i) blocked[first + i] = is_blocked(traced[i]);
    });
  }

  bool countable() const override { return false; }
  CountedWork count(Query, std::span<const Ray<float>>, std::span<Hit<float>>,
                    EngineScratch&) const override {
    throw std::logic_error("Embree cannot be watched");
  }
  std::vector<std::uint32_t> candidates(Query, const Ray<float>&, EngineScratch&) const override {
    throw std::logic_error("Embree cannot be watched");
  }
  StructureStats structure() const override { return {.bytes = scene_.bytes()}; }

 private:
  struct Scratch final : EngineScratch {
    std::array<RTCRayHit, kStreamRays> hits;
    std::array<RTCRay, kStreamRays> rays;
  };

  RTCIntersectContext new_context() const {
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    if (config_.coherent) context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
    return context;
  }

  /// Call `trace(first, count)` for one stream after the other, or for every ray on its own.
  template <class Function>
  void for_streams(std::size_t rays, const Function& trace) const {
    const std::size_t longest = config_.stream ? kStreamRays : 1;
    for (std::size_t first = 0; first < rays; first += longest)
      trace(first, static_cast<unsigned>(std::min(longest, rays - first)));
  }

  Hit<float> hit_of(const RTCRayHit& traced) const {
    if (traced.hit.geomID == RTC_INVALID_GEOMETRY_ID) return {};
    return {traced.ray.tfar, objects_.object(traced.hit.geomID, traced.hit.primID)};
  }

  EmbreeConfig config_;
  EmbreeScene scene_;
  EmbreeObjects objects_;
};

}  // namespace

const TechniqueEntry& baseline_embree() {
  static const TechniqueEntry entry{
      .info = {.id = "embree",
               .title = "Embree",
               .family = "baseline",
               .survey_section = "4",
               .paper = "Wald, Woop, Benthin, Johnson & Ernst 2014",
               .parameters =
                   {choice_parameter("quality", "medium", {"low", "medium", "high"},
                                     "Embree's build quality"),
                    boolean_parameter("robust", false, "watertight triangles and conservative boxes"),
                    choice_parameter("mode", "single", {"single", "stream"}, "rays handed over at a time"),
                    boolean_parameter("coherent", false, "tell Embree that the rays of a stream are alike"),
                    choice_parameter("spheres", "native", {"native", "user"}, "whose sphere test is used"),
                    boolean_parameter("flush_to_zero", false, "trace with denormal numbers taken as zero")},
               .own_object_test = true,
               .baseline = true},
      .build_float = [](const EngineInput<float>& input) -> std::unique_ptr<Engine<float>> {
        return std::make_unique<EmbreeEngine>(input);
      }};
  return entry;
}

}  // namespace rayshoot
