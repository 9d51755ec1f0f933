#include "harness/verify/exact/reading.h"

#include "harness/verify/exact/bounds.h"
#include "harness/verify/exact/find_root.h"
#include "harness/verify/exact/hierarchy.h"
#include "harness/verify/exact/sensitive.h"

namespace rayshoot::exact {

namespace {

/// Conditions for a contact, each 1, 0 or `kUnknown`, folded into one.
class Conditions {
 public:
  void require(int condition) {
    possible_ &= condition != 0;
    certain_ &= condition == 1;
  }
  bool possible() const { return possible_; }
  void add_to(Reading& reading, long double t) const {
    if (possible_ && !reading.possible) reading.possible = t;
    if (certain_ && !reading.certain) reading.certain = t;
  }

 private:
  bool possible_ = true, certain_ = true;
};

int condition(int firm_sign, int wanted) { return firm_sign == kUnknown ? kUnknown : firm_sign == wanted; }

/// The line of a ray in exact numbers and in sensitive ones, which are the first six inputs.
template <class Real>
struct Lines {
  Line<Dyadic> exact;
  Inputs inputs;
  Line<Sensitive> sensitive;

  explicit Lines(const Ray<Real>& ray)
      : exact(line_of<Dyadic>(ray)), sensitive{inputs(ray.origin), inputs(ray.direction)} {}
};

/// The parameter at which the ray enters the object's bounds, moved apart by half an ulp of everything.
template <class Real>
std::optional<double> entry(const ExactContacts<Real>& contacts, std::uint32_t object, const Ray<Real>& ray) {
  Box<double> box = exact_bounds(contacts, object);
  const Vec3d origin(ray.origin);
  const double largest = std::max({max_abs(box.lo), max_abs(box.hi), max_abs(origin)});
  const double margin = 4.0 * static_cast<double>(std::numeric_limits<Real>::epsilon()) * largest;
  box = {box.lo - Vec3d{margin, margin, margin}, box.hi + Vec3d{margin, margin, margin}};
  const SlabRay slabs(origin, Vec3d(ray.direction), ray.t_min);
  const auto enter = slabs.entry(box, slabs.scaled(ray.t_max));
  if (!enter) return std::nullopt;
  return std::max<double>(slabs.unscaled(*enter), ray.t_min);
}

/// A plane's meeting with the line, with both kinds of numbers.
struct FirmMeeting {
  PlaneMeeting<Dyadic> exact;
  PlaneMeeting<Sensitive> sensitive;

  int approach() const { return firm_sign(exact.approach, sensitive.approach); }
  /// The sign of t - end where the sign of the approach is firm.
  template <class Real>
  int after(Real end, Inputs inputs) const {
    const int s = firm_sign(exact.beyond(Dyadic(end)), sensitive.beyond(inputs(end)));
    return s == kUnknown ? s : s * sign(exact.approach);
  }
  template <class Real>
  void require_interval(const Ray<Real>& ray, const Inputs& inputs, Conditions& conditions) const {
    conditions.require(condition(after(ray.t_min, inputs), 1));
    if (ray.t_max < kMiss<Real>) conditions.require(condition(after(ray.t_max, inputs), -1));
  }
};

/// Whether a line nearly in the plane of a polygon may meet it: it does not pass all vertices on one side.
template <class Real>
bool may_graze(const Lines<Real>& lines, std::span<const Vec3<Real>> vertices, int axis) {
  const int u = (axis + 1) % 3, v = (axis + 2) % 3;
  const auto side = [u, v]<class Number>(const Line<Number>& line, const Vec3<Number>& vertex) {
    return line.direction[u] * (vertex[v] - line.origin[v]) -
           line.direction[v] * (vertex[u] - line.origin[u]);
  };
  bool left = false, right = false;
  for (const Vec3<Real>& vertex : vertices) {
    Inputs inputs = lines.inputs;
    const int s =
        firm_sign(side(lines.exact, numbers<Dyadic>(vertex)), side(lines.sensitive, inputs(vertex)));
    left |= s != 1, right |= s != -1;
  }
  return left && right;
}

/// The reading of a flat object whose plane the line may lie in: a contact anywhere in its bounds is possible.
template <class Real>
Reading read_grazed(const ExactContacts<Real>& contacts, std::uint32_t object, const Ray<Real>& ray,
                    const Lines<Real>& lines, std::span<const Vec3<Real>> vertices, int axis) {
  const auto enter = entry(contacts, object, ray);
  if (!enter || !may_graze(lines, vertices, axis)) return {};
  return {*enter, std::nullopt};
}

int largest_axis(const Vec3d& v) {
  const Vec3d size{std::abs(v.x), std::abs(v.y), std::abs(v.z)};
  return size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
}

template <class Real>
Reading read_triangle(const ExactContacts<Real>& contacts, std::uint32_t object, const Ray<Real>& ray) {
  const Triangle<Real>& triangle = contacts.geometry().triangle(object);
  const std::array corners{triangle.a, triangle.b, triangle.c};
  Lines<Real> lines(ray);
  std::array<Vec3<Dyadic>, 3> exact;
  std::array<Vec3<Sensitive>, 3> sensitive;
  for (std::size_t i = 0; i < 3; ++i)
    exact[i] = numbers<Dyadic>(corners[i]), sensitive[i] = lines.inputs(corners[i]);
  const FirmMeeting meeting{
      {lines.exact, triangle_normal(exact[0], exact[1], exact[2]), exact[0]},
      {lines.sensitive, triangle_normal(sensitive[0], sensitive[1], sensitive[2]), sensitive[0]}};

  // All edges must be passed on the side from which the plane is approached.
  const int approach = meeting.approach();
  Conditions inside;
  bool positive = false, negative = false;
  for (std::size_t i = 0; i < 3; ++i) {
    const std::size_t next = (i + 1) % 3;
    const int s = firm_sign(passing_side(lines.exact, exact[i], exact[next]),
                            passing_side(lines.sensitive, sensitive[i], sensitive[next]));
    positive |= s == 1, negative |= s == -1;
    inside.require(condition(s, approach));
  }
  if (positive && negative) return {};
  if (approach == kUnknown)
    return read_grazed<Real>(contacts, object, ray, lines, corners,
                             largest_axis(double_area_vector(triangle)));

  Reading reading;
  meeting.require_interval(ray, lines.inputs, inside);
  inside.add_to(reading, value(meeting.exact.root(approach)));
  return reading;
}

/// How far the components of Newell's area vector move: each vertex moves it by its own movement across the way
/// from the vertex before to the one after.
template <class Real>
Vec3<long double> normal_shift(std::span<const Vec3<Real>> vertices) {
  Vec3<long double> shift;
  for (std::size_t i = 0; i < vertices.size(); ++i) {
    const Vec3<long double> before(vertices[(i + vertices.size() - 1) % vertices.size()]);
    const Vec3<long double> across = Vec3<long double>(vertices[(i + 1) % vertices.size()]) - before;
    for (int axis = 0; axis < 3; ++axis) {
      const int u = (axis + 1) % 3, v = (axis + 2) % 3;
      shift[axis] +=
          (ulp(vertices[i][u]) * std::abs(across[v]) + ulp(vertices[i][v]) * std::abs(across[u])) / 2;
    }
  }
  return shift;
}

/// Whether the line may meet the plane of a polygon on the edge a-b.
template <class Real>
bool may_touch(const Lines<Real>& lines, const FirmMeeting& meeting, const Vec3<Real>& from,
               const Vec3<Real>& to, int dropped_axis) {
  Inputs inputs = lines.inputs;
  const Vec3<Sensitive> sensitive_from = inputs(from), sensitive_to = inputs(to);
  const Vec3<Dyadic> exact_from = numbers<Dyadic>(from), exact_to = numbers<Dyadic>(to);
  const int u = (dropped_axis + 1) % 3, v = (dropped_axis + 2) % 3;

  // The point must not lie beyond both ends of the edge.
  const auto seen = [&](const Vec3<Dyadic>& exact, const Vec3<Sensitive>& sensitive, int axis) {
    return firm_sign(meeting.exact.offset(lines.exact, exact, axis),
                     meeting.sensitive.offset(lines.sensitive, sensitive, axis));
  };
  for (const int axis : {u, v}) {
    const int one = seen(exact_from, sensitive_from, axis);
    if (one != kUnknown && one == seen(exact_to, sensitive_to, axis)) return false;
  }
  const auto side = [u, v](const auto& m, const auto& line, const auto& a, const auto& b) {
    return (b[u] - a[u]) * m.offset(line, a, v) - m.offset(line, a, u) * (b[v] - a[v]);
  };
  return firm_sign(side(meeting.exact, lines.exact, exact_from, exact_to),
                   side(meeting.sensitive, lines.sensitive, sensitive_from, sensitive_to)) == kUnknown;
}

template <class Real>
Reading read_polygon(const ExactContacts<Real>& contacts, std::uint32_t object, const Ray<Real>& ray) {
  const auto vertices = contacts.geometry().polygon_vertices(object);
  const int axis = contacts.geometry().polygon(object).dropped_axis;
  Lines<Real> lines(ray);
  const auto exact = numbers<Dyadic>(vertices);
  const Vec3<Dyadic> normal = newell_normal<Dyadic>(exact);
  const Vec3<long double> shift = normal_shift(vertices);
  Vec3<Sensitive> sensitive_normal;
  for (int k = 0; k < 3; ++k) sensitive_normal[k] = lines.inputs.moving(normal[k].rounded(), shift[k]);
  const FirmMeeting meeting{{lines.exact, normal, exact.front()},
                            {lines.sensitive, sensitive_normal, lines.inputs(vertices.front())}};
  const int approach = meeting.approach();
  if (approach == kUnknown) return read_grazed<Real>(contacts, object, ray, lines, vertices, axis);

  // On no edge, the point is where the exact test finds it.
  Conditions conditions;
  meeting.require_interval(ray, lines.inputs, conditions);
  if (!conditions.possible()) return {};
  bool touched = false;
  for (std::size_t i = 0; i < vertices.size() && !touched; ++i)
    touched = may_touch(lines, meeting, vertices[i], vertices[(i + 1) % vertices.size()], axis);
  Ray<Real> whole = ray;
  whole.t_min = -std::numeric_limits<Real>::max(), whole.t_max = kMiss<Real>;
  conditions.require(touched ? kUnknown : find_in_polygon<Dyadic>(whole, exact, normal, axis).hit);
  Reading reading;
  conditions.add_to(reading, value(meeting.exact.root(approach)));
  return reading;
}

/// A quadric's equation with both kinds of numbers, and its roots in increasing order.
struct FirmQuadratic {
  Quadratic<Dyadic> exact;
  Quadratic<Sensitive> sensitive;
  std::vector<ExactRoot> roots;

  int real() const { return firm_sign(exact.discriminant, sensitive.discriminant); }
  /// Where there may be roots but exactly there are none, they may be at the vertex of the parabola.
  void touch(int a_sign) {
    if (sign(exact.discriminant) < 0 && real() == kUnknown) roots = {exact.root(a_sign, 0)};
  }
  /// How far each root is from what `distance` measures; `unsure` where the nearest is not firmly on one side.
  template <class Distance>
  int side_of(std::size_t which, bool unsure, const Distance& distance) const {
    const long double own = distance(roots[which]);
    bool nearest = true;
    for (const ExactRoot& root : roots) nearest &= std::abs(own) <= std::abs(distance(root));
    return unsure && nearest ? kUnknown : own > 0 ? 1 : own < 0 ? -1 : 0;
  }
  template <class Real>
  int after(std::size_t which, Real end, Inputs inputs) const {
    const bool unsure = firm_sign(exact.at(Dyadic(end)), sensitive.at(inputs(end))) == kUnknown;
    return side_of(which, unsure, [&](const ExactRoot& root) { return difference(root, end); });
  }
  template <class Real>
  Conditions conditions(std::size_t which, const Ray<Real>& ray, const Inputs& inputs) const {
    Conditions result;
    result.require(roots.size() == 2 ? condition(real(), 1) : sign(exact.a) == 0 ? 1 : kUnknown);
    result.require(condition(after(which, ray.t_min, inputs), 1));
    if (ray.t_max < kMiss<Real>) {
      const int after_end = after(which, ray.t_max, inputs);
      result.require(after_end == 0 ? 1 : condition(after_end, -1));
    }
    return result;
  }
};

template <class Real>
Reading read_sphere(const ExactContacts<Real>& contacts, std::uint32_t object, const Ray<Real>& ray) {
  const Sphere<Real>& sphere = contacts.geometry().sphere(object);
  Lines<Real> lines(ray);
  FirmQuadratic quadratic{quadratic_of(lines.exact, sphere), {}, {}};
  const Vec3<Sensitive> centre = lines.inputs(sphere.centre);
  quadratic.sensitive = sphere_quadratic(lines.sensitive, centre, lines.inputs(sphere.radius));
  if (sign(quadratic.exact.discriminant) >= 0)
    quadratic.roots = {quadratic.exact.root(1, -1), quadratic.exact.root(1, 1)};
  quadratic.touch(1);
  Reading reading;
  for (std::size_t which = 0; which < quadratic.roots.size(); ++which)
    quadratic.conditions(which, ray, lines.inputs).add_to(reading, value(quadratic.roots[which]));
  return reading;
}

/// The exact and the sensitive forms of a cone.
struct FirmCone {
  ConeForms<Dyadic> exact;
  ConeForms<Sensitive> sensitive;
  FirmQuadratic quadratic;
  ConeRoots<Dyadic> roots;

  FirmCone(const ConeForms<Dyadic>& exact_forms, const ConeForms<Sensitive>& sensitive_forms)
      : exact(exact_forms),
        sensitive(sensitive_forms),
        quadratic{exact.quadratic, sensitive.quadratic, {}},
        roots(exact.quadratic) {
    for (int which = 0; which < roots.count; ++which) quadratic.roots.push_back(roots.root[which]);
    if (sign(exact.quadratic.a) != 0) quadratic.touch(sign(exact.quadratic.a));
  }

  /// Whether the line may run along the surface.
  bool along_surface() const {
    const auto& q = exact.quadratic;
    const auto& s = sensitive.quadratic;
    return firm_sign(q.a, s.a) == kUnknown && firm_sign(q.half_b, s.half_b) == kUnknown &&
           firm_sign(q.c, s.c) == kUnknown;
  }
  void require_segment(std::size_t which, Conditions& conditions) const {
    const long double slope = exact.height_slope.rounded();
    const auto height_above = [&](const Dyadic& from) {
      return [&, from](const ExactRoot& root) { return from.rounded() + slope * value(root); };
    };
    const bool at_base = firm_sign(exact.at_base_circle(), sensitive.at_base_circle()) == kUnknown;
    const bool at_apex = firm_sign(exact.at_apex_circle(), sensitive.at_apex_circle()) == kUnknown;
    const Dyadic& origin = exact.height_at_origin;
    const int above_base = quadratic.side_of(which, at_base, height_above(origin));
    const int above_apex = quadratic.side_of(which, at_apex, height_above(origin - exact.height_at_apex));
    conditions.require(above_base == 0 ? 1 : condition(above_base, 1));
    conditions.require(above_apex == 0 ? 1 : condition(above_apex, -1));
  }
};

template <class Real>
Reading read_cone(const ExactContacts<Real>& contacts, std::uint32_t object, const Ray<Real>& ray) {
  const Cone<Real>& cone = contacts.geometry().cone(object);
  Lines<Real> lines(ray);
  const Vec3<Sensitive> base = lines.inputs(cone.base), apex = lines.inputs(cone.apex);
  const Sensitive base_radius = lines.inputs(cone.base_radius);
  const FirmCone forms(
      forms_of(lines.exact, cone),
      ConeForms<Sensitive>(lines.sensitive, base, apex, base_radius, lines.inputs(cone.apex_radius)));
  Reading reading;
  if (forms.along_surface()) {
    if (const auto enter = entry(contacts, object, ray)) reading.possible = *enter;
    return reading;
  }
  const bool outside_only = contacts.geometry().cone_sides() == ConeSides::outside;
  for (std::size_t which = 0; which < forms.quadratic.roots.size(); ++which) {
    Conditions conditions = forms.quadratic.conditions(which, ray, lines.inputs);
    forms.require_segment(which, conditions);
    if (outside_only) {
      const bool tangent = sign(forms.exact.quadratic.a) != 0 && forms.quadratic.real() == kUnknown;
      conditions.require(tangent ? kUnknown : forms.roots.enters[which]);
    }
    conditions.add_to(reading, value(forms.quadratic.roots[which]));
  }
  return reading;
}

}  // namespace

template <class Real>
Reading read(const ExactContacts<Real>& contacts, std::uint32_t object, const Ray<Real>& ray) {
  switch (contacts.geometry().kind(object)) {
    case ObjectKind::triangle:
      return read_triangle(contacts, object, ray);
    case ObjectKind::polygon:
      return read_polygon(contacts, object, ray);
    case ObjectKind::sphere:
      return read_sphere(contacts, object, ray);
    case ObjectKind::cone:
      return read_cone(contacts, object, ray);
  }
  return {};
}

template Reading read(const ExactContacts<float>&, std::uint32_t, const Ray<float>&);
template Reading read(const ExactContacts<double>&, std::uint32_t, const Ray<double>&);

}  // namespace rayshoot::exact
