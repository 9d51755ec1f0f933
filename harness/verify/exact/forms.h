#pragma once

#include "harness/verify/exact/root.h"
#include "scenes/core/geometry.h"

/// The polynomials in the coordinates of a ray and an object whose signs decide all questions. Templates over
/// the number: bounded for the filter, exact behind it, and sensitive for the reach of half an ulp.
namespace rayshoot::exact {

template <class Number>
struct Line {
  Vec3<Number> origin, direction;
};

/// Whether the line passes an edge on one side (positive) or the other.
template <class Number>
Number passing_side(const Line<Number>& line, const Vec3<Number>& from, const Vec3<Number>& to) {
  return dot(to - from, cross(line.direction, from - line.origin));
}

template <class Number>
Vec3<Number> triangle_normal(const Vec3<Number>& a, const Vec3<Number>& b, const Vec3<Number>& c) {
  return cross(b - a, c - a);
}

/// The line meets a plane at t = distance / approach.
template <class Number>
struct PlaneMeeting {
  Number approach, distance;

  PlaneMeeting(const Line<Number>& line, const Vec3<Number>& normal, const Vec3<Number>& anchor)
      : approach(dot(normal, line.direction)), distance(dot(normal, anchor - line.origin)) {}

  /// Of the sign of the approach where the meeting lies beyond t.
  Number beyond(const Number& t) const { return distance - t * approach; }

  /// `approach_sign` is that of the approach.
  Root<Number> root(int approach_sign) const {
    if (approach_sign < 0) return {-distance, {}, -approach, 0};
    return {distance, {}, approach, 0};
  }

  /// Coordinate `axis` of the meeting as seen from a point, times the approach.
  Number offset(const Line<Number>& line, const Vec3<Number>& from, int axis) const {
    return (line.origin[axis] - from[axis]) * approach + distance * line.direction[axis];
  }
};

/// f(t) = a t^2 + 2 half_b t + c, zero where the line meets a quadric, negative inside.
template <class Number>
struct Quadratic {
  Number a, half_b, c;
  /// half_b^2 - a c.
  Number discriminant;

  Number at(const Number& t) const { return (a * t + half_b + half_b) * t + c; }
  /// One of the two roots where `a_sign`, the sign of a, is not zero.
  Root<Number> root(int a_sign, int side) const {
    if (a_sign < 0) return {half_b, discriminant, -a, side};
    return {-half_b, discriminant, a, side};
  }
  /// The only root where a is zero and `b_sign`, the sign of half_b, is not.
  Root<Number> linear_root(int b_sign) const {
    const Number b = half_b + half_b;
    if (b_sign < 0) return {c, {}, -b, 0};
    return {-c, {}, b, 0};
  }
};

/// The discriminant is |d|^2 r^2 - |(centre - o) x d|^2: in this form a far origin cancels less.
template <class Number>
Quadratic<Number> sphere_quadratic(const Line<Number>& line, const Vec3<Number>& centre,
                                   const Number& radius) {
  const Vec3<Number> to_centre = centre - line.origin, moment = cross(to_centre, line.direction);
  const Number a = dot(line.direction, line.direction), square = radius * radius;
  return {a, -dot(to_centre, line.direction), dot(to_centre, to_centre) - square,
          a * square - dot(moment, moment)};
}

/// A cone seen by a line. With v the way from base to apex and x that from the base to a point of the line,
/// |x x v|^2 / v^2 is its squared distance from the axis and (r0 v^2 + (r1 - r0) x.v) / v^2 the cone's radius
/// beside it; everything is multiplied by v^2 v^2.
template <class Number>
struct ConeForms {
  /// x.v at t = 0, its slope, and its value at the apex.
  Number height_at_origin, height_slope, height_at_apex;
  Quadratic<Number> quadratic;

  ConeForms(const Line<Number>& line, const Vec3<Number>& base, const Vec3<Number>& apex,
            const Number& base_radius, const Number& apex_radius) {
    const Vec3<Number> v = apex - base, from_base = line.origin - base;
    height_at_origin = dot(from_base, v), height_slope = dot(line.direction, v), height_at_apex = dot(v, v);
    const Vec3<Number> aside = cross(from_base, v), across = cross(line.direction, v);
    const Number widening = apex_radius - base_radius;
    const Number radius = base_radius * height_at_apex + widening * height_at_origin;
    const Number growth = widening * height_slope;
    const Number a = height_at_apex * dot(across, across) - growth * growth;
    const Number half_b = height_at_apex * dot(aside, across) - radius * growth;
    const Number c = height_at_apex * dot(aside, aside) - radius * radius;
    quadratic = {a, half_b, c, half_b * half_b - a * c};
  }
};

/// Newell's area vector: the sum over edges of previous x next, seen from the first vertex.
template <class Number>
Vec3<Number> newell_normal(std::span<const Vec3<Number>> vertices) {
  const Vec3<Number>& anchor = vertices.front();
  Vec3<Number> normal, previous = vertices.back() - anchor;
  for (const Vec3<Number>& vertex : vertices) {
    const Vec3<Number> next = vertex - anchor;
    normal += cross(previous, next);
    previous = next;
  }
  return normal;
}

}  // namespace rayshoot::exact
