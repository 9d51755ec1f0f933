#pragma once

#include "harness/verify/exact/contact.h"

/// The first root of an object's polynomial that lies on the object and in the ray's interval, for any kind of
/// number.
namespace rayshoot::exact {

/// `hit` is 1, 0 for a miss, or `kUnknown`.
template <class Number>
struct Found {
  int hit = 0;
  Root<Number> root;
};

/// Whether a root lies in (t_min, t_max] of a ray: 1, 0 or `kUnknown`.
template <class Number, class Real>
int within(const Root<Number>& root, const Ray<Real>& ray) {
  const int after_start = compare(root, ray.t_min), after_end = compare(root, ray.t_max);
  if (after_start == -1 || after_start == 0 || after_end == 1) return 0;
  return after_start == kUnknown || after_end == kUnknown ? kUnknown : 1;
}

template <class Number, class Real>
Quadratic<Number> quadratic_of(const Line<Number>& line, const Sphere<Real>& sphere) {
  return sphere_quadratic(line, numbers<Number>(sphere.centre), Number(sphere.radius));
}

template <class Number, class Real>
ConeForms<Number> forms_of(const Line<Number>& line, const Cone<Real>& cone) {
  return {line, numbers<Number>(cone.base), numbers<Number>(cone.apex), Number(cone.base_radius),
          Number(cone.apex_radius)};
}

template <class Number, class Real>
Found<Number> find_on_sphere(const Ray<Real>& ray, const Sphere<Real>& sphere) {
  const Quadratic<Number> quadratic = quadratic_of(line_of<Number>(ray), sphere);
  const int real = sign(quadratic.discriminant);
  if (real == kUnknown) return {kUnknown, {}};
  if (real < 0) return {};
  for (const int side : {-1, 1}) {
    const Root<Number> root = quadratic.root(1, side);
    if (const int hit = within(root, ray); hit != 0) return {hit, root};
  }
  return {};
}

/// Whether a root lies between the end circles of a cone: 1, 0 or `kUnknown`.
template <class Number>
int on_segment(const ConeForms<Number>& forms, const Root<Number>& root) {
  const int above_base = linear_sign(root, forms.height_at_origin, forms.height_slope);
  const int above_apex = linear_sign(root, forms.height_at_origin - forms.height_at_apex, forms.height_slope);
  if (above_base == -1 || above_apex == 1) return 0;
  return above_base == kUnknown || above_apex == kUnknown ? kUnknown : 1;
}

/// The roots of a cone's quadratic in increasing order, each with whether the ray enters the cone there.
template <class Number>
struct ConeRoots {
  int count = 0;
  Root<Number> root[2];
  bool enters[2] = {};
  bool unknown = false;

  explicit ConeRoots(const Quadratic<Number>& quadratic) {
    const int a = sign(quadratic.a), b = a == 0 ? sign(quadratic.half_b) : 0;
    const int real = a == 0 ? b * b : sign(quadratic.discriminant);
    unknown = a == kUnknown || b == kUnknown || real == kUnknown;
    if (unknown || real < 0 || (a == 0 && b == 0)) return;
    count = a == 0 ? 1 : 2;
    for (int which = 0; which < count; ++which) {
      const int side = which == 0 ? -1 : 1;
      root[which] = a == 0 ? quadratic.linear_root(b) : quadratic.root(a, side);
      enters[which] = a == 0 ? b < 0 : real > 0 && a * side < 0;
    }
  }
};

template <class Number, class Real>
Found<Number> find_on_cone(const Ray<Real>& ray, const Cone<Real>& cone, bool outside_only) {
  const ConeForms<Number> forms = forms_of(line_of<Number>(ray), cone);
  const ConeRoots<Number> roots(forms.quadratic);
  if (roots.unknown) return {kUnknown, {}};
  for (int which = 0; which < roots.count; ++which) {
    if (outside_only && !roots.enters[which]) continue;
    const int in_interval = within(roots.root[which], ray);
    if (in_interval == 0) continue;
    const int on_surface = on_segment(forms, roots.root[which]);
    if (on_surface != 0) return {std::max(in_interval, on_surface), roots.root[which]};
  }
  return {};
}

/// A vertex of a polygon in its projection, as seen from the point at which the ray meets the plane: the signs
/// of vertex - point.
struct SeenVertex {
  int u = 0, v = 0;
};

/// Even-odd inside test: which edges a line from the point crosses, each closed at its lower and open at its
/// upper end; and whether the point is on an edge.
template <class Number>
struct PolygonWalk {
  const PlaneMeeting<Number>& meeting;
  const Line<Number>& line;
  int approach_sign, u, v;
  bool inside = false, on_border = false, unknown = false;

  SeenVertex see(const Vec3<Number>& vertex) const { return {seen(vertex, u), seen(vertex, v)}; }
  int seen(const Vec3<Number>& vertex, int axis) const {
    const int s = sign(meeting.offset(line, vertex, axis));
    return s == kUnknown ? s : -s * approach_sign;
  }

  void edge(const Vec3<Number>& a, const SeenVertex& seen_a, const Vec3<Number>& b,
            const SeenVertex& seen_b) {
    if (seen_a.v == kUnknown || seen_b.v == kUnknown) {
      unknown = true;
    } else if ((seen_a.v > 0) != (seen_b.v > 0)) {
      crossing(a, b, seen_b.v > 0);
    } else if (seen_a.v == 0) {
      unknown |= seen_a.u == kUnknown || seen_b.u == kUnknown;
      on_border |= seen_a.u == 0 || (seen_b.v == 0 && seen_a.u * seen_b.u <= 0);
    }
  }

 private:
  void crossing(const Vec3<Number>& a, const Vec3<Number>& b, bool upward) {
    const Number side =
        (b[u] - a[u]) * meeting.offset(line, a, v) - meeting.offset(line, a, u) * (b[v] - a[v]);
    const int s = sign(side) * approach_sign;
    unknown |= std::abs(s) == kUnknown;
    on_border |= s == 0;
    inside ^= upward ? s > 0 : s < 0;
  }
};

template <class Number, class Real>
Found<Number> find_in_polygon(const Ray<Real>& ray, const std::vector<Vec3<Number>>& vertices,
                              const Vec3<Number>& normal, int dropped_axis) {
  // Meet the plane.
  const Line<Number> line = line_of<Number>(ray);
  const PlaneMeeting<Number> meeting(line, normal, vertices.front());
  const int approach = sign(meeting.approach);
  if (approach == kUnknown || approach == 0) return {approach, {}};
  const Root<Number> root = meeting.root(approach);
  const int in_interval = within(root, ray);
  if (in_interval == 0) return {};

  // Walk around the polygon.
  PolygonWalk<Number> walk{meeting, line, approach, (dropped_axis + 1) % 3, (dropped_axis + 2) % 3};
  SeenVertex previous = walk.see(vertices.back());
  for (std::size_t i = 0; i < vertices.size(); ++i) {
    const SeenVertex next = walk.see(vertices[i]);
    walk.edge(vertices[i == 0 ? vertices.size() - 1 : i - 1], previous, vertices[i], next);
    previous = next;
  }
  if (walk.unknown) return {kUnknown, {}};
  return {walk.inside || walk.on_border ? in_interval : 0, root};
}

}  // namespace rayshoot::exact
