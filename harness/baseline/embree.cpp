// Embree (Wald, Woop, Benthin, Johnson & Ernst 2014; Embree 3)
//
// Idea       What a practitioner would use instead: Embree's hierarchy with Embree's own ray-triangle test.
//            Polygons are cut into triangles; spheres are Embree's points; cones are user geometry with our
//            test, since Embree's own cones have caps. Its distances differ from ours in the last digits and
//            its choice between equal ones is open, so it is graded and not held to ==.
// Parameters quality         low builds along a Morton curve, medium by the surface area heuristic over bins,
//                            high with spatial splits, which rarely pay
//            robust          watertight triangles and conservative boxes, 10 to 25 % slower
//            mode            single traces ray by ray; stream hands over 256 rays at a time, packet 16 that go
//                            through the tree together; both pay where neighbours are alike
//            coherent        tells Embree that the rays of a stream or packet are alike: camera rays take half the
//                            time or the same, diffuse ones more than twice
//            spheres         native, or user: our sphere test behind a callback
//            flush_to_zero   trace with denormal numbers taken as zero, as Embree advises; off as everywhere
// Cost       not known: Embree does not count. About 64 bytes a triangle.
// Weak       long thin triangles in many directions, such as hair. Objects beyond 1.8e18 are invisible to it.
//            It aborts on rays that are not finite, so these miss without asking it. A native sphere that a
//            ray starts on exactly may be hit at t_min.
// Build      Debian's library has assertions on, which reports record. Beside it a release build of 3.13.5 was 0 to
//            4 % faster on coherent rays, equal on incoherent ones, and did not abort.

#include <array>
#include <stdexcept>

#include "accel/core/engine.h"
#include "harness/baseline/baselines.h"
#include "harness/baseline/denormals.h"
#include "harness/baseline/embree_objects.h"
#include "harness/baseline/embree_rays.h"

namespace rayshoot {

namespace {

constexpr std::size_t kStreamRays = 256;

/// How many rays are handed over at a time.
enum class Mode { single, stream, packet };

struct EmbreeConfig {
  RTCBuildQuality quality;
  Mode mode;
  bool robust, coherent, native_spheres, flush_to_zero;

  explicit EmbreeConfig(const Arguments& arguments)
      : robust(arguments.boolean("robust")),
        coherent(arguments.boolean("coherent")),
        native_spheres(arguments.text("spheres") == "native"),
        flush_to_zero(arguments.boolean("flush_to_zero")) {
    const std::string &name = arguments.text("quality"), &handed_over = arguments.text("mode");
    quality = name == "low"    ? RTC_BUILD_QUALITY_LOW
              : name == "high" ? RTC_BUILD_QUALITY_HIGH
                               : RTC_BUILD_QUALITY_MEDIUM;
    mode = handed_over == "stream" ? Mode::stream : handed_over == "packet" ? Mode::packet : Mode::single;
    if (coherent && mode == Mode::single)
      throw InputError("embree: coherent=on needs mode=stream or mode=packet");
  }
};

class EmbreeEngine final : public Engine<float> {
 public:
  explicit EmbreeEngine(const EngineInput<float>& input)
      : config_(input.arguments),
        scene_(config_.quality, config_.robust),
        objects_(input.geometry, config_.native_spheres, scene_) {
    scene_.build();
  }

  std::unique_ptr<EngineScratch> scratch() const override {
    return std::make_unique<Scratch>(config_.coherent);
  }

  void closest(std::span<const Ray<float>> rays, std::span<Hit<float>> hits,
               EngineScratch& scratch) const override {
    auto& buffers = static_cast<Scratch&>(scratch);
    const FlushToZero flush(config_.flush_to_zero);
    in_batches(rays.size(), [&](std::size_t first, std::size_t count) {
      const auto batch = rays.subspan(first, count);
      if (config_.mode == Mode::packet)
        closest_of_packet(batch, hits.subspan(first, count), buffers);
      else
        closest_of_stream(batch, hits.subspan(first, count), buffers);
    });
  }

  void any(std::span<const Ray<float>> rays, std::span<std::uint8_t> blocked,
           EngineScratch& scratch) const override {
    auto& buffers = static_cast<Scratch&>(scratch);
    const FlushToZero flush(config_.flush_to_zero);
    in_batches(rays.size(), [&](std::size_t first, std::size_t count) {
      const auto batch = rays.subspan(first, count);
      if (config_.mode == Mode::packet)
        any_of_packet(batch, blocked.subspan(first, count), buffers);
      else
        any_of_stream(batch, blocked.subspan(first, count), buffers);
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
    explicit Scratch(bool coherent) {
      rtcInitIntersectContext(&context);
      if (coherent) context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
    }

    RTCIntersectContext context;
    std::array<RTCRayHit, kStreamRays> hits;
    std::array<RTCRay, kStreamRays> rays;
    RTCRayHit16 packet;
    alignas(64) PacketMask mask;
  };

  /// Call `trace(first, count)` for one stream or packet after the other, or for every ray on its own.
  template <class Function>
  void in_batches(std::size_t rays, const Function& trace) const {
    const std::size_t longest = config_.mode == Mode::stream   ? kStreamRays
                                : config_.mode == Mode::packet ? kPacketRays
                                                               : 1;
    for (std::size_t first = 0; first < rays; first += longest) trace(first, std::min(longest, rays - first));
  }

  /// A stream, or a single ray.
  void closest_of_stream(std::span<const Ray<float>> rays, std::span<Hit<float>> hits,
                         Scratch& buffers) const {
    for (std::size_t i = 0; i < rays.size(); ++i) {
      buffers.hits[i].ray = embree_ray(rays[i]);
      buffers.hits[i].hit.geomID = RTC_INVALID_GEOMETRY_ID;
    }
    if (config_.mode == Mode::stream)
      rtcIntersect1M(scene_.get(), &buffers.context, buffers.hits.data(), static_cast<unsigned>(rays.size()),
                     sizeof(RTCRayHit));
    else
      rtcIntersect1(scene_.get(), &buffers.context, buffers.hits.data());
    for (std::size_t i = 0; i < rays.size(); ++i) {
      const auto& [ray, hit] = buffers.hits[i];
      hits[i] = hit_of(ray.tfar, hit.geomID, hit.primID);
    }
  }

  void any_of_stream(std::span<const Ray<float>> rays, std::span<std::uint8_t> blocked,
                     Scratch& buffers) const {
    for (std::size_t i = 0; i < rays.size(); ++i) buffers.rays[i] = embree_ray(rays[i]);
    if (config_.mode == Mode::stream)
      rtcOccluded1M(scene_.get(), &buffers.context, buffers.rays.data(), static_cast<unsigned>(rays.size()),
                    sizeof(RTCRay));
    else
      rtcOccluded1(scene_.get(), &buffers.context, buffers.rays.data());
    for (std::size_t i = 0; i < rays.size(); ++i) blocked[i] = is_blocked(buffers.rays[i].tfar);
  }

  void closest_of_packet(std::span<const Ray<float>> rays, std::span<Hit<float>> hits,
                         Scratch& buffers) const {
    auto& [packet, hit] = buffers.packet;
    fill(packet, buffers.mask, rays);
    for (unsigned& geometry : hit.geomID) geometry = RTC_INVALID_GEOMETRY_ID;
    rtcIntersect16(buffers.mask.data(), scene_.get(), &buffers.context, &buffers.packet);
    for (std::size_t i = 0; i < rays.size(); ++i)
      hits[i] = hit_of(packet.tfar[i], hit.geomID[i], hit.primID[i]);
  }

  void any_of_packet(std::span<const Ray<float>> rays, std::span<std::uint8_t> blocked,
                     Scratch& buffers) const {
    RTCRay16& packet = buffers.packet.ray;
    fill(packet, buffers.mask, rays);
    rtcOccluded16(buffers.mask.data(), scene_.get(), &buffers.context, &packet);
    for (std::size_t i = 0; i < rays.size(); ++i) blocked[i] = is_blocked(packet.tfar[i]);
  }

  Hit<float> hit_of(float t, unsigned part, unsigned primitive) const {
    if (part == RTC_INVALID_GEOMETRY_ID) return {};
    return {t, objects_.object(part, primitive)};
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
                    choice_parameter("mode", "single", {"single", "stream", "packet"},
                                     "rays handed over at a time: 1, 256 or 16"),
                    boolean_parameter("coherent", false,
                                      "tell Embree that the rays of a stream or packet are alike"),
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
