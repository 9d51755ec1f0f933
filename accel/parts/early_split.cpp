#include "accel/parts/early_split.h"

#include <tbb/parallel_for.h>
#include <tbb/parallel_reduce.h>

#include <cmath>
#include <numeric>

#include "accel/parts/clipped_bounds.h"

namespace rayshoot {

namespace {

using Hull = std::vector<Vec3d>;

/// A sliver's box is so many times as large as its two sides. A triangle in a cube's diagonal plane comes to 4.
constexpr double kVoid = 32;
/// Nothing is cut unless a uniformly distributed ray meets the boxes of so many slivers on its way through the scene:
/// pieces take memory, and where fewer are met, as in tessellated cones, to fetch them costs more than they save.
constexpr double kMetByRay = 256;
/// Pieces of one object. A hair that is cut into 64 has but a 64th of the surface of its box left.
constexpr int kMostPieces = 64;

double area(const Hull& corners) {
  Vec3d twice{};
  for (std::size_t i = 2; i < corners.size(); ++i)
    twice = twice + cross(corners[i - 1] - corners[0], corners[i] - corners[0]);
  return std::sqrt(dot(twice, twice)) / 2;
}

/// The surface area of a sliver's box; 0 for what is no sliver.
template <class Real>
double void_area(const Geometry<Real>& geometry, const BoxedObject<Real>& object) {
  const double box = object.box.surface_area();
  const Hull corners = hull_corners(geometry, object.object);
  const bool is_sliver = !corners.empty() && box > kVoid * 2 * area(corners);
  return is_sliver && box <= std::numeric_limits<float>::max() ? box : 0;
}

/// How many pieces each object is cut into: A / k is left of a diagonal hair's box by k pieces, so that by the same
/// derivative everywhere k grows with the root of A.
class Shares {
 public:
  Shares(std::span<const double> areas, double most) {
    double least = 0, largest = std::sqrt(*std::max_element(areas.begin(), areas.end()));
    for (int step = 0; step < 40; ++step) {
      unit_ = (least + largest) / 2;
      const double sum = std::accumulate(areas.begin(), areas.end(), 0.0, [this](double added, double area) {
        return added + pieces(area) - 1;
      });
      (sum > most ? least : largest) = unit_;
    }
    unit_ = largest;
  }

  int pieces(double area) const {
    return static_cast<int>(std::clamp(std::sqrt(area) / unit_, 1.0, double{kMostPieces}));
  }

 private:
  double unit_;
};

template <class Real>
class Cutter {
 public:
  Cutter(Real margin, const BoxedObject<Real>& whole, BoxedObject<Real>* into)
      : margin_(margin), whole_(whole), into_(into) {}

  /// Cut a part of the object across the middle of its longest side until there are so many pieces.
  void cut(const Hull& part, int pieces) {
    Box<double> box;
    for (const Vec3d& corner : part) box.include(corner);
    if (pieces == 1 || part.empty()) return keep(box, pieces);
    const Vec3d extent = box.extent();
    const int axis = extent.x >= extent.y && extent.x >= extent.z ? 0 : extent.y >= extent.z ? 1 : 2;
    const int lower = pieces / 2;
    const double middle = box.lo[axis] + extent[axis] * lower / pieces;
    cut(clipped(part, axis, 1, middle), lower);
    cut(clipped(part, axis, -1, -middle), pieces - lower);
  }

 private:
  void keep(const Box<double>& box, int pieces) {
    const Box<Real> rounded{Vec3<Real>(box.lo), Vec3<Real>(box.hi)};
    const Box<Real> kept = box.empty() ? whole_.box : common(whole_.box, widened(padded(rounded), margin_));
    into_ = std::fill_n(into_, pieces, BoxedObject<Real>{kept, whole_.object});
  }

  Real margin_;
  BoxedObject<Real> whole_;
  BoxedObject<Real>* into_;
};

/// The boxes that a uniformly distributed ray meets on its way through the scene.
template <class Real>
double met_by_ray(const Geometry<Real>& geometry, std::span<const BoxedObject<Real>> objects) {
  const double areas = tbb::parallel_deterministic_reduce(
      tbb::blocked_range<std::size_t>(0, objects.size(), 4096), 0.0,
      [&](const auto& part, double sum) {
        for (std::size_t i = part.begin(); i < part.end(); ++i) {
          const LaneBox<Real> box = objects[i].lanes();
          sum += 2 * BoxUnion<Real>{box.lo, box.hi}.half_area();
        }
        return sum;
      },
      std::plus<>());
  return areas / geometry.bounds().surface_area();
}

}  // namespace

template <class Real>
std::optional<SurfaceMargin<Real>> split_slivers(const Geometry<Real>& geometry, double budget,
                                                 HugeVector<BoxedObject<Real>>& objects) {
  // By equation (2) a box is met as often as its surface is large: all together may be met too rarely already.
  if (budget == 0 || !(met_by_ray<Real>(geometry, objects) > kMetByRay)) return std::nullopt;

  // Measure how much void each object's box holds.
  std::vector<double> areas(objects.size());
  tbb::parallel_for(std::size_t{0}, objects.size(),
                    [&](std::size_t i) { areas[i] = void_area(geometry, objects[i]); });
  const double met = std::accumulate(areas.begin(), areas.end(), 0.0) / geometry.bounds().surface_area();
  if (!(met > kMetByRay)) return std::nullopt;

  // Share the budget out.
  const Shares shares(areas, budget * static_cast<double>(objects.size()));
  std::vector<std::size_t> first(objects.size() + 1);
  for (std::size_t i = 0; i < objects.size(); ++i) {
    const int pieces = areas[i] > 0 ? shares.pieces(areas[i]) : 1;
    first[i + 1] = first[i] + static_cast<std::size_t>(pieces);
  }

  // Cut.
  const SurfaceMargin<Real> margin(geometry.bounds());
  HugeVector<BoxedObject<Real>> cut(first.back());
  tbb::parallel_for(std::size_t{0}, objects.size(), [&](std::size_t i) {
    const auto pieces = static_cast<int>(first[i + 1] - first[i]);
    BoxedObject<Real>* const into = &cut[first[i]];
    if (pieces == 1)
      *into = objects[i];
    else
      Cutter<Real>(margin.of_cells(), objects[i], into)
          .cut(hull_corners(geometry, objects[i].object), pieces);
  });
  objects = std::move(cut);
  return margin;
}

template std::optional<SurfaceMargin<float>> split_slivers(const Geometry<float>&, double,
                                                           HugeVector<BoxedObject<float>>&);
template std::optional<SurfaceMargin<double>> split_slivers(const Geometry<double>&, double,
                                                            HugeVector<BoxedObject<double>>&);

}  // namespace rayshoot
