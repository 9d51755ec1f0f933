// teapot, Newell's teapot on a checkerboard (SPD package)
//
// Purpose    The teapot in the stadium: small triangles with vertex normals, dense and curved, among few
//            large squares.
// Size       64 size² - 8 size triangles and size² squares: 3 → 561, 6 → 2292, 12 → 9264 (default), 16 →
//            16512. The program of the package has the default 6, but every published figure was measured at
//            12.
// Weak       Size 1 would fold patches of the lid and the bottom onto themselves: sizes begin at 2.

#include "scenes/spd/database.h"
#include "scenes/spd/teapot_table.h"

namespace rayshoot {

namespace {

/// A patch in the power basis: P(s, t) is the sum over r and c of s^(3-r) t^(3-c) [r][c].
using Coefficients = std::array<std::array<Vec3d, 4>, 4>;

struct PatchPoint {
  Vec3d position, normal;
};

/// From Bezier control points to the power basis: M G M, with the symmetric basis matrix M.
Coefficients power_basis(const std::array<std::uint16_t, 16>& indices) {
  constexpr double basis[4][4] = {{-1, 3, -3, 1}, {3, -6, 3, 0}, {-3, 3, 0, 0}, {1, 0, 0, 0}};
  Coefficients half{}, coefficients{};
  for (int r = 0; r < 4; ++r)
    for (int c = 0; c < 4; ++c)
      for (int k = 0; k < 4; ++k) half[r][c] += teapot::kControlPoints[indices[4 * k + c]] * basis[r][k];
  for (int r = 0; r < 4; ++r)
    for (int c = 0; c < 4; ++c)
      for (int k = 0; k < 4; ++k) coefficients[r][c] += half[r][k] * basis[k][c];
  return coefficients;
}

std::array<double, 4> powers(double t) { return {t * t * t, t * t, t, 1}; }
std::array<double, 4> power_slopes(double t) { return {3 * t * t, 2 * t, 1, 0}; }

Vec3d combine(const Coefficients& patch, const std::array<double, 4>& rows,
              const std::array<double, 4>& columns) {
  Vec3d sum{};
  for (int c = 0; c < 4; ++c) {
    Vec3d column{};
    for (int r = 0; r < 4; ++r) column += patch[r][c] * rows[r];
    sum += column * columns[c];
  }
  return sum;
}

/// A point of a patch and the normal there, which is not a number where the patch comes to a point. The basis
/// and the order of summation are the original's: with them, numbers on the verge of two roundings print as
/// its do.
PatchPoint evaluate(const Coefficients& patch, double s, double t) {
  const Vec3d along_s = combine(patch, power_slopes(s), powers(t));
  const Vec3d along_t = combine(patch, powers(s), power_slopes(t));
  return {combine(patch, powers(s), powers(t)), normalized(cross(along_t, along_s))};
}

/// Whether a point lies on the axis, where the patches of the lid and of the bottom come to a point.
bool is_cusp(const Vec3d& p) { return std::abs(p.x) <= 1e-4 && std::abs(p.y) <= 1e-4; }

/// Emit a triangle unless it collapsed into the axis; a single corner there gets a vertical normal.
void emit(SceneBuilder& builder, std::array<PatchPoint, 3> corners) {
  int cusps = 0;
  for (PatchPoint& corner : corners) {
    if (!is_cusp(corner.position)) continue;
    ++cusps;
    corner.normal = {0, 0, corner.position.z > 1.5 ? 1.0 : -1.0};
  }
  if (cusps > 1) return;
  builder.patch({corners[0].position, corners[1].position, corners[2].position},
                {corners[0].normal, corners[1].normal, corners[2].normal});
}

void emit_patch(SceneBuilder& builder, const std::array<std::uint16_t, 16>& indices, int cells) {
  const auto whole_patch = builder.group();
  const Coefficients patch = power_basis(indices);
  const auto corner = [&](int i, int j) {
    return evaluate(patch, static_cast<double>(i) / cells, static_cast<double>(j) / cells);
  };
  for (int i = 0; i < cells; ++i)
    for (int j = 0; j < cells; ++j) {
      const PatchPoint a = corner(i, j), b = corner(i, j + 1), c = corner(i + 1, j + 1), d = corner(i + 1, j);
      emit(builder, {a, b, c});
      emit(builder, {c, d, a});
    }
}

/// The squares of one colour of the checkerboard.
void emit_squares(SceneBuilder& builder, int size, int parity) {
  const auto squares = builder.group();
  const auto at = [&](int k) { return 4 * (2.0 * k / size - 1); };
  for (int i = 0; i < size; ++i)
    for (int j = 0; j < size; ++j)
      if ((i + j) % 2 == parity)
        builder.polygon(std::array{Vec3d{at(i), at(j), 0}, Vec3d{at(i + 1), at(j), 0},
                                   Vec3d{at(i + 1), at(j + 1), 0}, Vec3d{at(i), at(j + 1), 0}});
}

void generate(const SceneOptions& options, const Arguments&, SceneBuilder& builder) {
  spd::open(builder, {.from = {4.86, 7.2, 5.4}, .at = {0, 0, 0}, .up = {0, 0, 1}, .angle = 45, .hither = 1},
            {{-3.1, 9.8, 12.1}, {11.3, 5.1, 8.8}});
  builder.material({{1, 1, 1}, 0.5, 0.5, shine_from_highlight_angle(30), 0, 0});
  emit_squares(builder, options.size, 1);
  builder.material({{0.5, 0.5, 0.5}, 0.5, 0.5, shine_from_highlight_angle(30), 0, 0});
  emit_squares(builder, options.size, 0);
  builder.material({{1, 0.5, 0.1}, 0.75, 0.25, shine_from_highlight_angle(37), 0, 0});
  for (const auto& patch : teapot::kPatches) emit_patch(builder, patch, options.size);
}

double object_count(const SceneOptions& options, const Arguments&) {
  const double s = options.size;
  return 65 * s * s - 8 * s;
}

}  // namespace

const SceneGenerator& scene_teapot() {
  static const SceneGenerator generator{
      .id = "teapot",
      .title = "Teapot",
      .source = spd::kPackage,
      .default_size = 12,
      .min_size = 2,
      .purpose =
          "small smooth triangles, densely packed on a coarse checkerboard; "
          "65 size^2 - 8 size triangles and squares",
      .parameters = {},
      .object_count = object_count,
      .generate = generate};
  return generator;
}

}  // namespace rayshoot
