#pragma once

#include <span>

#include "scenes/core/affine.h"
#include "scenes/core/scene.h"

namespace rayshoot {

/// In what form curved objects are generated (SPD's output modes).
enum class SceneForm { curves, patches };

/// What every generator is asked for.
struct SceneOptions {
  int size = 1;
  SceneForm form = SceneForm::curves;
  /// SPD's resolution R of patches: a sphere becomes 12 R^2 triangles, a cone 8 R.
  int tessellation = 3;
};

/// Receives what a generator emits, in order. In the form `patches` spheres and cones arrive in the scene as
/// triangles with vertex normals, exactly as SPD tessellates them.
class SceneBuilder {
 public:
  explicit SceneBuilder(const SceneOptions& options = {});

  void background(const Vec3d& colour) { scene_.background = colour; }
  void view(const View& view) { scene_.view = view; }
  void light(const Vec3d& position, const std::optional<Vec3d>& colour = std::nullopt) {
    scene_.lights.push_back({position, colour});
  }
  /// The material of all that follows.
  void material(const Material& material) { scene_.materials.push_back(material); }

  void triangle(const Vec3d& a, const Vec3d& b, const Vec3d& c);
  /// A triangle with vertex normals (NFF `pp 3`).
  void patch(const std::array<Vec3d, 3>& vertices, const std::array<Vec3d, 3>& normals);
  /// A polygon; three vertices make a triangle.
  void polygon(std::span<const Vec3d> vertices);
  /// A polygon with vertex normals (NFF `pp`).
  void polygon(std::span<const Vec3d> vertices, std::span<const Vec3d> normals);
  void sphere(const Vec3d& centre, double radius);
  void cone(const Vec3d& base, double base_radius, const Vec3d& apex, double apex_radius);

  /// A part, which stands there at the time 0 and moves by `velocity` until the time 1.
  void place(std::shared_ptr<const Scene> part, const Affine& scene_from_part, const Vec3d& velocity = {});

  /// Spheres and cones that follow are given, and tessellated, in a frame of their own, which `frame` maps
  /// into the scene: a rotation and translation together with a scaling by `scale`. Vertex normals map by the
  /// inverse transposed and are not normalised again, so they end up 1/scale long. Only jacks asks for this.
  void place_in(const Affine& frame, double scale) { frame_ = frame, scale_ = scale; }
  /// Replace the tessellation asked for; only jacks does.
  void override_tessellation(int resolution) { options_.tessellation = resolution; }

  /// Keeps what is emitted during its life together as a group; a tessellated sphere or cone is one by itself.
  class GroupScope {
   public:
    explicit GroupScope(SceneBuilder& builder) : builder_(builder) { builder_.open_group(); }
    ~GroupScope() { builder_.close_group(); }
    GroupScope(const GroupScope&) = delete;
    GroupScope& operator=(const GroupScope&) = delete;

   private:
    SceneBuilder& builder_;
  };
  [[nodiscard]] GroupScope group() { return GroupScope(*this); }

  /// Throws InputError where parts are placed so often that their objects cannot be numbered.
  Scene finish() &&;

 private:
  void open_group();
  void close_group();
  void add_object(ObjectKind kind, std::size_t index, std::uint32_t first_normal = kNoObject);
  void placed_patch(const std::array<Vec3d, 3>& vertices, const std::array<Vec3d, 3>& normals);
  void tessellate_sphere(const Vec3d& centre, double radius);
  void tessellate_cone(const Cone<double>& cone);

  SceneOptions options_;
  Affine frame_;
  double scale_ = 1;
  Scene scene_;
  /// The groups that are open, outermost first.
  std::vector<std::uint32_t> open_groups_;
};

/// The same scene with every sphere and cone, also in parts, replaced by the triangles that SPD's resolution `tessellation`
/// makes of it. (jacks tessellates in a way of its own, so ask its generator for patches instead.)
Scene tessellated(const Scene& scene, int tessellation);

/// Number of objects a sphere or a cone becomes in the form asked for.
double patches_of_sphere(const SceneOptions& options);
double patches_of_cone(const SceneOptions& options);

/// The Phong exponent at which a highlight falls to half its height at `degrees` from its centre.
double shine_from_highlight_angle(double degrees);

}  // namespace rayshoot
