#include "accel/parts/volume_kinds.h"

#include <numbers>

namespace rayshoot {

namespace {

constexpr double kPi = std::numbers::pi;

/// Volumes are computed with so many roundings at the most that this part of their size and place covers them.
constexpr double kFitError = 64 * std::numeric_limits<double>::epsilon();

std::array<Vec3d, 3> coordinate_axes() { return {Vec3d{1, 0, 0}, Vec3d{0, 1, 0}, Vec3d{0, 0, 1}}; }

/// The balls' extent along three axes, from a point.
Box<double> extent_along(std::span<const SurfaceBall> balls, const std::array<Vec3d, 3>& axes,
                         const Vec3d& from) {
  Box<double> extent;
  for (const SurfaceBall& ball : balls) {
    const Vec3d offset = ball.centre - from;
    const Vec3d at{dot(offset, axes[0]), dot(offset, axes[1]), dot(offset, axes[2])};
    const Vec3d radius{ball.radius, ball.radius, ball.radius};
    extent.include(Box<double>{at - radius, at + radius});
  }
  return extent;
}

Vec3d mean_of(std::span<const SurfaceBall> balls) {
  Vec3d sum{};
  const double weight = 1 / static_cast<double>(balls.size());
  for (const SurfaceBall& ball : balls) sum += ball.centre * weight;
  return sum;
}

using Matrix = std::array<std::array<double, 3>, 3>;

/// The covariance of the centres, in units of their largest distance from the mean along an axis.
Matrix covariance(std::span<const SurfaceBall> balls, const Vec3d& mean) {
  double largest = 0;
  for (const SurfaceBall& ball : balls) largest = std::max(largest, max_abs(ball.centre - mean));
  Matrix matrix{};
  if (!(largest > 0) || !std::isfinite(1 / largest)) return matrix;
  for (const SurfaceBall& ball : balls) {
    const Vec3d p = (ball.centre - mean) * (1 / largest);
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) matrix[i][j] += p[i] * p[j];
  }
  return matrix;
}

/// The eigenvectors of a symmetric matrix by Jacobi's rotations.
std::array<Vec3d, 3> eigenvectors(Matrix m) {
  std::array<Vec3d, 3> vectors = coordinate_axes();
  for (int sweep = 0; sweep < 12; ++sweep)
    for (int p = 0; p < 2; ++p)
      for (int q = p + 1; q < 3; ++q) {
        if (std::abs(m[p][q]) <= 1e-15 * (std::abs(m[p][p]) + std::abs(m[q][q]))) continue;
        const double angle = 0.5 * std::atan2(2 * m[p][q], m[q][q] - m[p][p]);
        const double c = std::cos(angle), s = std::sin(angle);
        for (int k = 0; k < 3; ++k) {
          const double a = m[k][p], b = m[k][q];
          m[k][p] = c * a - s * b, m[k][q] = s * a + c * b;
        }
        for (int k = 0; k < 3; ++k) {
          const double a = m[p][k], b = m[q][k];
          m[p][k] = c * a - s * b, m[q][k] = s * a + c * b;
        }
        const Vec3d a = vectors[p], b = vectors[q];
        vectors[p] = a * c - b * s, vectors[q] = a * s + b * c;
      }
  const Vec3d first = normalized(vectors[0]), third = normalized(cross(first, vectors[1]));
  return {first, cross(third, first), third};
}

/// By how much to grow a volume that reaches so far from the coordinates' origin.
double fit_margin(const Vec3d& centre, double reach) { return kFitError * (max_abs(centre) + reach); }

template <class Real>
Volume<Real> fit_axis_box(const Box<Real>& bounds) {
  return {.kind = VolumeKind::axis_box, .place = {Vec3d(bounds.lo), Vec3d(bounds.hi)}};
}

/// The smallest sphere about that centre.
template <class Real>
Volume<Real> sphere_about(std::span<const SurfaceBall> balls, const Vec3d& centre) {
  double radius = 0;
  for (const SurfaceBall& ball : balls) radius = std::max(radius, length(ball.centre - centre) + ball.radius);
  return {.kind = VolumeKind::sphere, .place = {centre, {radius + fit_margin(centre, radius), 0, 0}}};
}

template <class Real>
Volume<Real> fit_sphere(std::span<const SurfaceBall> balls, const Vec3d& mean) {
  const Box<double> extent = extent_along(balls, coordinate_axes(), mean);
  const Volume<Real> about_middle = sphere_about<Real>(balls, mean + extent.centre());
  const Volume<Real> about_mean = sphere_about<Real>(balls, mean);
  return about_middle.half().x <= about_mean.half().x ? about_middle : about_mean;
}

/// The point at coordinates `at` of a frame.
Vec3d from_frame(const std::array<Vec3d, 3>& axes, const Vec3d& origin, const Vec3d& at) {
  return origin + axes[0] * at.x + axes[1] * at.y + axes[2] * at.z;
}

template <class Real>
Volume<Real> fit_oriented_box(std::span<const SurfaceBall> balls, const std::array<Vec3d, 3>& axes,
                              const Vec3d& mean) {
  const Vec3d centre = from_frame(axes, mean, extent_along(balls, axes, mean).centre());
  const Box<double> extent = extent_along(balls, axes, centre);
  const Vec3d reach = max(-extent.lo, extent.hi);
  const double margin = fit_margin(centre, max_abs(reach));
  return {.kind = VolumeKind::oriented_box,
          .place = {centre, reach + Vec3d{margin, margin, margin}},
          .axes = axes};
}

/// The smallest cylinder about the line through the middle of an oriented box along one of its axes.
template <class Real>
Volume<Real> cylinder_along(std::span<const SurfaceBall> balls, const Volume<Real>& box, int along) {
  const Vec3d& axis = box.axes[along];
  double radius = 0;
  for (const SurfaceBall& ball : balls) {
    const Vec3d offset = ball.centre - box.centre();
    radius = std::max(radius, length(offset - axis * dot(offset, axis)) + ball.radius);
  }
  const double margin = fit_margin(box.centre(), radius + max_abs(box.half()));
  return {.kind = VolumeKind::cylinder,
          .place = {box.centre(), {box.half()[along], radius + margin, radius + margin}},
          .axes = {axis, box.axes[(along + 1) % 3], box.axes[(along + 2) % 3]}};
}

template <class Real>
Volume<Real> fit_cylinder(std::span<const SurfaceBall> balls, const Volume<Real>& box) {
  Volume<Real> best = cylinder_along(balls, box, 0);
  for (const int along : {1, 2}) {
    const Volume<Real> other = cylinder_along(balls, box, along);
    if (other.surface_area() < best.surface_area()) best = other;
  }
  return best;
}

}  // namespace

Parameter volume_kind_parameter() {
  std::vector<std::string> words{"best"};
  words.insert(words.end(), kVolumeKindNames.begin(), kVolumeKindNames.end());
  return choice_parameter("volumes", "best", words, "kind of the volumes");
}

std::optional<VolumeKind> volume_kind(const Arguments& arguments) {
  const auto named = std::find(kVolumeKindNames.begin(), kVolumeKindNames.end(), arguments.text("volumes"));
  if (named == kVolumeKindNames.end()) return std::nullopt;
  return static_cast<VolumeKind>(named - kVolumeKindNames.begin());
}

std::vector<std::string> volume_kind_events() {
  std::vector<std::string> events;
  for (const std::string kind : kVolumeKindNames) events.push_back(kind + "_tests");
  return events;
}

template <class Real>
double Volume<Real>::surface_area() const {
  switch (kind) {
    case VolumeKind::axis_box:
      return Box<double>{place[0], place[1]}.surface_area();
    case VolumeKind::sphere:
      return 4 * kPi * half().x * half().x;
    case VolumeKind::oriented_box:
      return 8 * (half().x * half().y + half().y * half().z + half().z * half().x);
    case VolumeKind::cylinder:
      return 2 * kPi * half().y * (half().y + 2 * half().x);
  }
  return 0;
}

template <class Real>
Vec3d Volume<Real>::half_extent() const {
  if (kind == VolumeKind::axis_box) return (place[1] - place[0]) * 0.5;
  if (kind == VolumeKind::sphere) return {half().x, half().x, half().x};
  return half();
}

template <class Real>
std::array<Vec3d, 3> Volume<Real>::frame() const {
  return kind == VolumeKind::axis_box || kind == VolumeKind::sphere ? coordinate_axes() : axes;
}

template <class Real>
Vec3d Volume<Real>::point(const Vec3d& at) const {
  const Vec3d middle = kind == VolumeKind::axis_box ? (place[0] + place[1]) * 0.5 : centre();
  const Vec3d extent = half_extent();
  return from_frame(frame(), middle, {at.x * extent.x, at.y * extent.y, at.z * extent.z});
}

template <class Real>
bool Volume<Real>::holds(const Vec3d& point) const {
  const Interval<Real> interval =
      inside(VolumeRay<Real>(Ray<Real>{.origin = Vec3<Real>(point), .direction = {1, 0, 0}}));
  return interval.enter <= 0 && interval.exit >= 0;
}

template <class Real>
Box<Real> Volume<Real>::bounds() const {
  if (kind == VolumeKind::axis_box) return {Vec3<Real>(place[0]), Vec3<Real>(place[1])};
  const std::array<Vec3d, 3> along = frame();
  const Vec3d extent = half_extent();
  Vec3d reach{};
  for (int axis = 0; axis < 3; ++axis)
    for (int k = 0; k < 3; ++k) reach[axis] += std::abs(along[k][axis]) * extent[k];
  Box<Real> box;
  box.include(Vec3<Real>(centre() - reach)), box.include(Vec3<Real>(centre() + reach));
  return padded(box);
}

template <class Real>
double Volume<Real>::enclosed_volume() const {
  const Vec3d extent = half_extent();
  const double thinnest = kSurfaceError<Real> * (extent.x + extent.y + extent.z);
  const Vec3d h = extent + Vec3d{thinnest, thinnest, thinnest};
  switch (kind) {
    case VolumeKind::axis_box:
    case VolumeKind::oriented_box:
      return 8 * h.x * h.y * h.z;
    case VolumeKind::sphere:
      return 4 * kPi / 3 * h.x * h.x * h.x;
    case VolumeKind::cylinder:
      return 2 * kPi * h.x * h.y * h.y;
  }
  return 0;
}

std::array<Vec3d, 3> box_axes(std::span<const SurfaceBall> balls) {
  const Vec3d mean = mean_of(balls);
  const std::array<Vec3d, 3> principal = eigenvectors(covariance(balls, mean));
  const double turned = extent_along(balls, principal, mean).surface_area();
  return turned < extent_along(balls, coordinate_axes(), mean).surface_area() ? principal : coordinate_axes();
}

template <class Real>
std::array<Volume<Real>, 4> bounding_volumes(std::span<const SurfaceBall> balls, const Box<Real>& bounds) {
  const Vec3d mean = mean_of(balls);
  const Volume<Real> box = fit_oriented_box<Real>(balls, box_axes(balls), mean);
  return {fit_sphere<Real>(balls, mean), fit_axis_box(bounds), box, fit_cylinder(balls, box)};
}

template <class Real>
std::array<Volume<Real>, 4> bounding_volumes(const Geometry<Real>& geometry,
                                             std::span<const std::uint32_t> objects) {
  std::vector<SurfaceBall> balls;
  Box<Real> bounds;
  for (const std::uint32_t object : objects) {
    append_surface(geometry, object, balls);
    bounds.include(geometry.bounds(object));
  }
  return bounding_volumes(std::span<const SurfaceBall>(balls), bounds);
}

template <class Real>
const Volume<Real>& cheapest_volume(std::span<const Volume<Real>> volumes, VolumeFit fit) {
  const auto product = [fit](const Volume<Real>& volume) {
    const double measure =
        fit == VolumeFit::enclosed_volume ? volume.enclosed_volume() : volume.projected_area();
    return measure * volume.relative_cost();
  };
  return *std::min_element(volumes.begin(), volumes.end(),
                           [&](const auto& a, const auto& b) { return product(a) < product(b); });
}

#define RAYSHOOT_INSTANTIATE(REAL)                                                                       \
  template struct Volume<REAL>;                                                                          \
  template std::array<Volume<REAL>, 4> bounding_volumes(std::span<const SurfaceBall>, const Box<REAL>&); \
  template std::array<Volume<REAL>, 4> bounding_volumes(const Geometry<REAL>&,                           \
                                                        std::span<const std::uint32_t>);                 \
  template const Volume<REAL>& cheapest_volume(std::span<const Volume<REAL>>, VolumeFit);

RAYSHOOT_INSTANTIATE(float)
RAYSHOOT_INSTANTIATE(double)

}  // namespace rayshoot
