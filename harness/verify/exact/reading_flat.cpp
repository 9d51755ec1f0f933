#include "harness/verify/exact/find_root.h"
#include "harness/verify/exact/firm.h"

namespace rayshoot::exact {

namespace {

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
    conditions.require(condition(after(ray.t_max, inputs), -1));
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
  whole.t_min = -std::numeric_limits<Real>::max(), whole.t_max = std::numeric_limits<Real>::max();
  conditions.require(touched ? kUnknown : find_in_polygon<Dyadic>(whole, exact, normal, axis).hit);
  Reading reading;
  conditions.add_to(reading, value(meeting.exact.root(approach)));
  return reading;
}

}  // namespace

template <class Real>
Reading read_flat(const ExactContacts<Real>& contacts, std::uint32_t object, const Ray<Real>& ray) {
  const bool is_triangle = contacts.geometry().kind(object) == ObjectKind::triangle;
  return is_triangle ? read_triangle(contacts, object, ray) : read_polygon(contacts, object, ray);
}

template Reading read_flat(const ExactContacts<float>&, std::uint32_t, const Ray<float>&);
template Reading read_flat(const ExactContacts<double>&, std::uint32_t, const Ray<double>&);

}  // namespace rayshoot::exact
