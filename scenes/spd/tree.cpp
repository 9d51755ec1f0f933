// tree, a binary tree of cones and spheres (Haines 1987; after Aono and Kunii)
//
// Purpose    Objects whose sizes span orders of magnitude, clustered at the twigs, over a field a hundred
//            times as wide as the tree: hard for any uniform subdivision.
// Size       2^(size+1) - 1 cones, as many spheres, one polygon: 8 → 1023, 11 → 8191 (default), 12 → 16383.

#include "scenes/spd/database.h"

namespace rayshoot {

namespace {

constexpr double kTrunkRadius = 0.15;
/// By how much a branch narrows from its base to its apex, and from one generation to the next.
constexpr double kTaper = 0.67;

/// Where a branch puts its two children: turned and shrunk, upon its tip.
std::array<Affine, 2> child_placements() {
  const auto placement = [](double branching_degrees, double diverging_degrees, double contraction) {
    const Affine turn = compose(rotation({0, 0, 1}, spd::radians(diverging_degrees)),
                                rotation({1, 0, 0}, spd::radians(branching_degrees)));
    return compose(translation({0, 0, 1}), compose(scaling(contraction), turn));
  };
  return {placement(40, 90, 0.65), placement(25, 230, 0.70)};
}

void grow(SceneBuilder& builder, const std::array<Affine, 2>& children, const Affine& place, double scale,
          int depth) {
  const auto branch_with_children = builder.group();
  const Vec3d base = place({0, 0, 0}), tip = place({0, 0, 1});
  const double tip_radius = kTaper * kTrunkRadius * scale;
  builder.cone(base, kTrunkRadius * scale, tip, tip_radius);
  builder.sphere(tip, tip_radius);
  if (depth == 0) return;
  for (const Affine& child : children)
    grow(builder, children, compose(place, child), scale * kTaper, depth - 1);
}

void generate(const SceneOptions& options, const Arguments&, SceneBuilder& builder) {
  spd::open(builder, {.from = {4.5, 0.4, 2}, .at = {0, 0, 1.5}, .up = {0, 0, 1}, .angle = 45, .hither = 1},
            {{-5, 5, 50},
             {30, -30, 30},
             {-40, -30, 20},
             {10, 30, 40},
             {-30, 40, 10},
             {50, 25, 20},
             {-10, -60, 30}});
  builder.material({{0.2, 0.7, 0.2}, 1, 0, spd::kNoHighlight, 0, 0});
  builder.polygon(std::array{Vec3d{50, 50, 0}, Vec3d{-50, 50, 0}, Vec3d{-50, -50, 0}, Vec3d{50, -50, 0}});
  builder.material({{0.55, 0.4, 0.2}, 1, 0, spd::kNoHighlight, 0, 0});
  grow(builder, child_placements(), {}, 1, options.size);
}

double object_count(const SceneOptions& options, const Arguments&) {
  const double branches = std::pow(2, options.size + 1) - 1;
  return 1 + branches * (patches_of_sphere(options) + patches_of_cone(options));
}

}  // namespace

const SceneGenerator& scene_tree() {
  static const SceneGenerator generator{.id = "tree",
                                        .title = "Tree",
                                        .source = spd::kPaper,
                                        .default_size = 11,
                                        .min_size = 1,
                                        .purpose =
                                            "cones and spheres of widely varying size, clustered over a vast "
                                            "field; 2^(size+2) - 1 objects",
                                        .parameters = {},
                                        .object_count = object_count,
                                        .generate = generate};
  return generator;
}

}  // namespace rayshoot
