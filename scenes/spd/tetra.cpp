// tetra, the tetrahedral pyramid (Glassner; Haines 1987)
//
// Purpose    Triangles alone, all of one size, whose bounding volumes are mostly empty: a Sierpinski
//            tetrahedron.
// Size       4^size triangles: 4 → 256, 6 → 4096 (default), 8 → 65536, 11 → 4194304.

#include "scenes/spd/database.h"

namespace rayshoot {

namespace {

/// Every second corner of a cube: the corners of a regular tetrahedron.
constexpr std::array<Vec3d, 4> kCorners{Vec3d{-1, -1, 1}, Vec3d{-1, 1, -1}, Vec3d{1, -1, -1}, Vec3d{1, 1, 1}};

void tetrahedron(SceneBuilder& builder, const Vec3d& centre, double half) {
  std::array<Vec3d, 4> q;
  for (int i = 0; i < 4; ++i) q[i] = centre + kCorners[i] * half;
  builder.triangle(q[0], q[1], q[2]);
  builder.triangle(q[3], q[2], q[1]);
  builder.triangle(q[2], q[3], q[0]);
  builder.triangle(q[1], q[0], q[3]);
}

/// A tetrahedron in a cube of the given centre and half width; above level 1, four of half the size at its
/// corners.
void divide(SceneBuilder& builder, const Vec3d& centre, double half, int level) {
  const auto pyramid = builder.group();
  if (level == 1) return tetrahedron(builder, centre, half);
  for (const Vec3d& corner : kCorners) divide(builder, centre + corner * (half / 2), half / 2, level - 1);
}

void generate(const SceneOptions& options, const Arguments&, SceneBuilder& builder) {
  spd::open(builder,
            {.from = {1.022846, -3.177154, -2.174512},
             .at = {-0.004103, -0.004103, 0.216539},
             .up = {-0.816497, -0.816497, 0.816497},
             .angle = 45,
             .hither = 1},
            {{2, -18, -5}});
  builder.material({{1, 0.2, 0.2}, 1, 0, spd::kNoHighlight, 0, 0});
  divide(builder, {0, 0, 0}, 1, options.size);
}

double object_count(const SceneOptions& options, const Arguments&) { return std::pow(4, options.size); }

}  // namespace

const SceneGenerator& scene_tetra() {
  static const SceneGenerator generator{.id = "tetra",
                                        .title = "Tetrahedral pyramid",
                                        .source = spd::kPaper,
                                        .default_size = 6,
                                        .min_size = 1,
                                        .purpose =
                                            "a Sierpinski tetrahedron of equal triangles in mostly empty "
                                            "space; 4^size triangles",
                                        .parameters = {},
                                        .object_count = object_count,
                                        .generate = generate};
  return generator;
}

}  // namespace rayshoot
