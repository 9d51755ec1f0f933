#include "scenes/io/nff.h"

#include <fmt/format.h>

#include <cerrno>
#include <charconv>
#include <cstring>
#include <filesystem>
#include <fstream>

#include "scenes/core/scene_builder.h"
#include "scenes/core/spec.h"
#include "scenes/io/output_file.h"
#include "scenes/io/text_reader.h"

namespace rayshoot {

namespace {

/// Reads one record after the other into a scene.
class NffReader {
 public:
  NffReader(std::istream& in, const std::string& name) : text_(in, name) {}

  Scene read() && {
    while (text_.next_line()) read_record();
    if (!has_view_) text_.fail("the file ends without a view (record v)");
    return std::move(builder_).finish();
  }

 private:
  void read_record() {
    const std::string_view record = text_.word();
    if (record == "pp") {
      read_polygon(true);
    } else if (record == "p") {
      read_polygon(false);
    } else if (record == "s") {
      read_sphere();
    } else if (record == "c") {
      read_cone();
    } else if (record == "f") {
      read_material();
    } else if (record == "l") {
      read_light();
    } else if (record == "b") {
      read_background();
    } else if (record == "v") {
      read_view();
    } else {
      refuse_record(record);
    }
    text_.end_line();
  }

  [[noreturn]] void refuse_record(std::string_view record) const {
    const std::string name = shown(record);
    if (std::strchr("+-.0123456789", name.front()))
      text_.fail(fmt::format("a record should begin here, not the number {}", name));
    text_.fail(unknown_name("record", name, {"b", "v", "l", "f", "p", "pp", "s", "c"}));
  }

  void read_background() {
    if (has_background_) text_.fail("a second background");
    has_background_ = true;
    builder_.background(text_.point("the background colour"));
  }

  void read_view() {
    if (has_view_) text_.fail("a second view");
    has_view_ = true;
    text_.end_line();
    View view;
    begin_view_line("from"), view.from = text_.point("from"), text_.end_line();
    begin_view_line("at"), view.at = text_.point("at"), text_.end_line();
    begin_view_line("up"), view.up = text_.point("up"), text_.end_line();
    begin_view_line("angle"), view.angle = text_.number("angle");
    if (!(view.angle > 0 && view.angle < 180))
      text_.fail("the angle of view must lie between 0 and 180 degrees");
    text_.end_line();
    begin_view_line("hither"), view.hither = text_.number("hither"), text_.end_line();
    begin_view_line("resolution");
    view.width = text_.integer("the resolution", 1), view.height = text_.integer("the resolution", 1);
    builder_.view(view);
  }

  void begin_view_line(std::string_view key) {
    if (!text_.next_line()) text_.fail(fmt::format("the file ends inside a view: '{}' is missing", key));
    if (text_.word() != key) text_.fail(fmt::format("the view needs '{}' here", key));
  }

  void read_light() {
    const Vec3d position = text_.point("the light's position");
    if (text_.line_is_done()) return builder_.light(position);
    builder_.light(position, text_.point("the light's colour"));
  }

  void read_material() {
    Material material;
    material.colour = text_.point("the colour");
    material.diffuse = text_.number("Kd"), material.specular = text_.number("Ks");
    material.shine = text_.number("Shine"), material.transmittance = text_.number("T");
    material.index_of_refraction = text_.number("the index of refraction");
    builder_.material(material);
    has_material_ = true;
  }

  void expect_object() const {
    if (!has_view_) text_.fail("an object before the view (record v)");
    if (!has_material_) text_.fail("an object before any material (record f)");
  }

  void read_sphere() {
    expect_object();
    const Vec3d centre = text_.point("the centre");
    builder_.sphere(centre, radius());
  }

  void read_cone() {
    expect_object();
    const Vec3d base = end_of_cone("the base");
    const double base_radius = radius();
    const Vec3d apex = end_of_cone("the apex");
    builder_.cone(base, base_radius, apex, radius());
  }

  /// Either end of a cone may stand on a line of its own.
  Vec3d end_of_cone(std::string_view what) {
    if (text_.line_is_done() && !text_.next_line())
      text_.fail(fmt::format("the file ends inside a cone: {} is missing", what));
    return text_.point(what);
  }

  double radius() {
    const double radius = text_.number("the radius");
    if (radius < 0) text_.fail(fmt::format("the radius {:g} is negative", radius));
    return radius;
  }

  void read_polygon(bool with_normals) {
    expect_object();
    const int count = text_.integer("the number of vertices", 0);
    if (count < 3) text_.fail(fmt::format("polygon has {} vertices; at least 3 are needed", count));
    text_.end_line();
    vertices_.clear(), normals_.clear();
    for (int corner = 1; corner <= count; ++corner) {
      if (corner > 1) text_.end_line();
      if (!text_.next_line())
        text_.fail(fmt::format("the file ends inside a polygon: vertex {} of {} is missing", corner, count));
      vertices_.push_back(text_.point("a vertex of the polygon"));
      if (with_normals) normals_.push_back(text_.point("a vertex normal of the polygon"));
    }
    with_normals ? builder_.polygon(vertices_, normals_) : builder_.polygon(vertices_);
  }

  TextReader text_;
  SceneBuilder builder_;
  bool has_background_ = false, has_view_ = false, has_material_ = false;
  std::vector<Vec3d> vertices_, normals_;
};

/// Writes records with numbers of a given precision.
class NffWriter {
 public:
  NffWriter(std::ostream& out, int precision) : out_(out), precision_(precision) {}

  void write(const Scene& scene) {
    record("b", scene.background);
    write_view(scene.view);
    for (const Light& light : scene.lights)
      light.colour ? record("l", light.position, *light.colour) : record("l", light.position);
    write_objects(scene);
    flush();
  }

 private:
  void write_view(const View& view) {
    record("v");
    record("from", view.from);
    record("at", view.at);
    record("up", view.up);
    record("angle", view.angle);
    record("hither", view.hither);
    text_ += fmt::format("resolution {} {}\n", view.width, view.height);
  }

  /// Materials keep their order, and those without objects are written too.
  void write_objects(const Scene& scene) {
    std::size_t written = 0, current = 0;
    const auto write_new_materials = [&](std::size_t end) {
      for (; written < end; ++written) write_material(scene.materials[written]);
    };
    for (std::uint32_t object = 0; object < scene.size(); ++object) {
      const std::size_t material = scene.objects[object].material;
      if (material < written && material != current) write_material(scene.materials[material]);
      write_new_materials(material + 1);
      current = material;
      write_object(scene, object);
      if (text_.size() > kFlushBytes) flush();
    }
    write_new_materials(scene.materials.size());
  }

  void write_material(const Material& m) {
    record("f", m.colour, m.diffuse, m.specular, m.shine, m.transmittance, m.index_of_refraction);
  }

  void write_object(const Scene& scene, std::uint32_t object) {
    const SceneObject& entry = scene.objects[object];
    if (entry.kind == ObjectKind::sphere) {
      const Sphere<double>& sphere = scene.spheres[entry.index];
      record("s", sphere.centre, sphere.radius);
    } else if (entry.kind == ObjectKind::cone) {
      const Cone<double>& cone = scene.cones[entry.index];
      record("c", cone.base, cone.base_radius, cone.apex, cone.apex_radius);
    } else {
      write_polygon(scene, object);
    }
  }

  void write_polygon(const Scene& scene, std::uint32_t object) {
    const std::uint32_t first_normal = scene.objects[object].first_normal;
    const bool smooth = first_normal != kNoObject;
    const std::uint32_t count = scene.vertex_count(object);
    text_ += fmt::format("{} {}\n", smooth ? "pp" : "p", count);
    for (std::uint32_t corner = 0; corner < count; ++corner) {
      number(scene.vertex(object, corner));
      if (smooth) number(scene.vertex_normals[first_normal + corner]);
      text_.back() = '\n';
    }
  }

  /// One line: a key and its numbers.
  template <class... Numbers>
  void record(std::string_view key, const Numbers&... numbers) {
    text_ += key;
    text_ += ' ';
    (number(numbers), ...);
    text_.back() = '\n';
  }

  void number(const Vec3d& v) { number(v.x), number(v.y), number(v.z); }

  void number(double value) {
    if (!std::isfinite(value))
      throw InputError("the scene holds a number that is not finite, which NFF cannot express");
    char digits[32];
    const auto result =
        std::to_chars(digits, digits + sizeof digits, value, std::chars_format::general, precision_);
    text_.append(digits, result.ptr);
    text_ += ' ';
  }

  void flush() {
    out_.write(text_.data(), static_cast<std::streamsize>(text_.size()));
    text_.clear();
  }

  static constexpr std::size_t kFlushBytes = 1 << 16;

  std::ostream& out_;
  int precision_;
  std::string text_;
};

}  // namespace

Scene read_nff(std::istream& in, const std::string& name) { return NffReader(in, name).read(); }

Scene read_nff(const std::string& path) {
  errno = 0;
  std::ifstream in(path, std::ios::binary);
  if (!in) throw InputError(fmt::format("cannot read {}: {}", path, std::strerror(errno)));
  if (std::filesystem::is_directory(path))
    throw InputError(fmt::format("cannot read {}: it is a directory", path));
  return read_nff(in, path);
}

void write_nff(const Scene& scene, std::ostream& out, int precision) {
  if (precision < 1 || precision > kFullPrecision)
    throw InputError(
        fmt::format("a precision of {} digits is not accepted; 1 to {} are", precision, kFullPrecision));
  require_nothing_placed(scene, "NFF");
  NffWriter(out, precision).write(scene);
}

void write_nff(const Scene& scene, const std::string& path, int precision) {
  OutputFile file(path);
  write_nff(scene, file.stream(), precision);
  file.commit();
}

}  // namespace rayshoot
