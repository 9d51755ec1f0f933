#pragma once

#include <memory>
#include <string>

#include "scenes/core/scene_builder.h"
#include "scenes/core/triangle_mesh.h"
#include "scenes/stiff/parts/rays.h"

namespace rayshoot::stiff {

/// What the builder holds, as a scene of that name.
std::shared_ptr<const Scene> share(SceneBuilder&& builder, const std::string& id);

/// The triangles of a mesh.
void add_mesh(SceneBuilder& builder, const TriangleMesh& mesh);
/// The twelve triangles of a box, two a face, over eight shared corners.
void add_box(SceneBuilder& builder, const Vec3d& lo, const Vec3d& hi);

/// How many objects of each kind.
struct Counts {
  int triangles = 0, parallelograms = 0, spheres = 0, cones = 0;
};
/// Objects about `extent` wide scattered over the cube [-1, 1]^3, all their numbers multiples of `step`: so
/// parallelograms are exactly flat.
void add_scattered(SceneBuilder& builder, const Counts& counts, const RandomNumbers& random, double extent,
                   double step);
/// A few objects of every kind, all numbers multiples of `step`.
Scene mixed_scene(std::uint64_t seed, double step, int objects_of_a_kind = 40);

/// The scene with every point p at p scale + offset and every radius multiplied by `scale`, rounded to floats.
Scene placed(const Scene& scene, double scale, const Vec3d& offset = {});
/// The scene under a name of its own.
std::shared_ptr<const Scene> share(Scene scene, const std::string& id);

/// A ray of floats between points that are multiples of `step`: from the cube of twice `half_width` around the origin
/// to a vertex of a triangle of the scene, every other one to a random point of the cube of `half_width`.
Ray<double> lattice_ray(const Scene& scene, const RandomNumbers& random, std::uint64_t number, double step,
                        double half_width);

}  // namespace rayshoot::stiff
