// Fuzz target: objects and rays of any bits, among good ones, traced by any technique in any configuration, scalar and
// intersector. Nothing crashes or hangs, and all answers are those of a plain loop over the objects.
#include <cstring>

#include "accel/tests/conformance.h"
#include "scenes/core/scene_builder.h"

namespace rayshoot {
namespace {

/// Reads numbers off the input; zeros when it is used up.
class Bytes {
 public:
  Bytes(const std::uint8_t* data, std::size_t size) : data_(data), size_(size) {}

  template <class Number>
  Number next() {
    Number number{};
    const std::size_t count = std::min(sizeof number, size_);
    std::memcpy(&number, data_, count);
    data_ += count, size_ -= count;
    return number;
  }
  bool empty() const { return size_ == 0; }

  /// Any float, or a multiple of a quarter between -4 and 4: such numbers make ties and touches.
  double coordinate() {
    const auto kind = next<std::uint8_t>();
    return kind % 4 == 0 ? double{next<float>()} : (kind / 4 % 33 - 16) * 0.25;
  }
  Vec3d point() { return {coordinate(), coordinate(), coordinate()}; }

 private:
  const std::uint8_t* data_;
  std::size_t size_;
};

void add_object(SceneBuilder& builder, Bytes& bytes) {
  switch (bytes.next<std::uint8_t>() % 5) {
    case 0:
      return builder.sphere(bytes.point(), bytes.coordinate());
    case 1:
      return builder.cone(bytes.point(), bytes.coordinate(), bytes.point(), bytes.coordinate());
    case 2:
      return builder.polygon(std::array{bytes.point(), bytes.point(), bytes.point(), bytes.point()});
    default:
      return builder.triangle(bytes.point(), bytes.point(), bytes.point());
  }
}

Scene scene_of(Bytes& bytes) {
  SceneBuilder builder;
  builder.material({});
  builder.triangle({-3, -3, 2}, {3, -3, 2}, {0, 3, 2});
  builder.sphere({0, 0, -2}, 1);
  for (int objects = bytes.next<std::uint8_t>() % 24; objects > 0; --objects) add_object(builder, bytes);
  return std::move(builder).finish();
}

/// A ray, of three in four unbounded.
template <class Real>
Ray<Real> ray_of(Bytes& bytes) {
  Ray<Real> ray{.origin = Vec3<Real>(bytes.point()), .direction = Vec3<Real>(bytes.point())};
  if (bytes.next<std::uint8_t>() % 4 == 0)
    ray.t_min = static_cast<Real>(bytes.coordinate()), ray.t_max = static_cast<Real>(bytes.coordinate());
  return ray;
}

/// A ray as documented and finite: of others nothing is promised but that they end.
template <class Real>
bool ordinary(const Ray<Real>& ray) {
  return is_finite(ray.origin) && is_finite(ray.direction) && ray.direction != Vec3<Real>{} &&
         ray.t_min >= 0 && std::isfinite(ray.t_max);
}

template <class Real>
void trace(Bytes& bytes) {
  const auto& entries = technique_entries();
  const TechniqueEntry& entry = *entries[bytes.next<std::uint8_t>() % entries.size()];
  const auto variants = conformance::variants(entry);
  const Arguments arguments = variants[bytes.next<std::uint8_t>() % variants.size()].arguments();
  const auto intersector = static_cast<Intersector>(bytes.next<std::uint8_t>() % kIntersectorNames.size());
  const Geometry<Real> geometry(scene_of(bytes), ConeSides::both, intersector);
  const auto engine = entry.build<Real>({geometry, arguments});

  std::vector<Ray<Real>> rays;
  std::vector<Ray<Real>> odd;
  for (int count = 0; count < 8 && (count == 0 || !bytes.empty()); ++count) {
    const Ray<Real> ray = ray_of<Real>(bytes);
    (ordinary(ray) ? rays : odd).push_back(ray);
  }
  rays.push_back({.origin = {0, 0, 9}, .direction = {0, 0, -1}});
  const auto truths = conformance::truths<Real>(geometry, rays);
  conformance::check_engine<Real>(*engine, rays, truths);
  std::vector<Hit<Real>> hits(odd.size());
  engine->closest(odd, hits, *engine->scratch());
  engine->count(Query::strict, odd, hits, *engine->scratch());
  if (::testing::Test::HasFailure()) std::abort();
}

}  // namespace
}  // namespace rayshoot

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  rayshoot::Bytes bytes(data, size);
  if (bytes.next<std::uint8_t>() % 2 == 0)
    rayshoot::trace<float>(bytes);
  else
    rayshoot::trace<double>(bytes);
  return 0;
}
