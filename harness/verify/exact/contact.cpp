#include "harness/verify/exact/contact.h"

#include "harness/verify/exact/find_root.h"

namespace rayshoot::exact {

namespace {

using Filter = Bounded<double>;

/// A double with the bound of its last rounding.
Filter rounded(const ExactRoot& root) { return {static_cast<double>(value(root)), 0}; }

/// The sign of the passing of edge `from`-`to`, exactly.
template <class Real>
int edge_sign(const Line<Filter>& line, const Ray<Real>& ray, const Vec3<Real>& from, const Vec3<Real>& to) {
  const int filtered = sign(passing_side(line, numbers<Filter>(from), numbers<Filter>(to)));
  if (filtered != kUnknown) return filtered;
  return sign(passing_side(line_of<Dyadic>(ray), numbers<Dyadic>(from), numbers<Dyadic>(to)));
}

/// The sign with which the line passes a triangle on the same side of all edges, or on edges; 0 for a miss.
template <class Real>
int common_side(const Triangle<Real>& triangle, const Ray<Real>& ray, const Line<Filter>& line) {
  int common = 0;
  const std::array corners{&triangle.a, &triangle.b, &triangle.c, &triangle.a};
  for (int edge = 0; edge < 3; ++edge) {
    const int side = edge_sign(line, ray, *corners[edge], *corners[edge + 1]);
    if (side * common < 0) return 0;
    if (side != 0) common = side;
  }
  return common;
}

template <class Number, class Real>
PlaneMeeting<Number> meeting(const Triangle<Real>& triangle, const Line<Number>& line) {
  const Vec3<Number> a = numbers<Number>(triangle.a);
  return {line, triangle_normal(a, numbers<Number>(triangle.b), numbers<Number>(triangle.c)), a};
}

template <class Number>
Root<Number> meeting_root(const PlaneMeeting<Number>& meeting) {
  // Bounded division does not ask for a positive scale; exact numbers know their sign.
  return meeting.root(sign(meeting.approach) == -1 ? -1 : 1);
}

/// Search with the filter, then exactly where that does not settle it. `search` is a template over the kind of
/// number.
template <class Search>
std::optional<Contact> filtered(std::uint32_t object, const Search& search) {
  const Found<Filter> quick = search.template operator()<Filter>();
  if (quick.hit == 0) return std::nullopt;
  if (quick.hit == 1) return Contact{object, quick.root.side, value(quick.root)};
  const Found<Dyadic> slow = search.template operator()<Dyadic>();
  if (slow.hit == 0) return std::nullopt;
  return Contact{object, slow.root.side, rounded(slow.root)};
}

}  // namespace

template <class Real>
ExactContacts<Real>::ExactContacts(const Geometry<Real>& geometry) : geometry_(geometry) {
  for (std::uint32_t object = 0; object < geometry.size(); ++object) {
    if (geometry.kind(object) != ObjectKind::polygon) continue;
    polygon_normals_.resize(std::max<std::size_t>(polygon_normals_.size(), geometry.index(object) + 1));
    polygon_normals_[geometry.index(object)] =
        newell_normal<Filter>(numbers<Filter>(geometry.polygon_vertices(object)));
  }
}

template <class Real>
std::optional<Contact> ExactContacts<Real>::triangle_contact(std::uint32_t object,
                                                             const Ray<Real>& ray) const {
  const Triangle<Real>& triangle = geometry_.triangle(object);
  const Line<Filter> line = line_of<Filter>(ray);
  // The approach is the sum of the three sides, hence not zero where they agree.
  const int side = common_side(triangle, ray, line);
  if (side == 0) return std::nullopt;
  const Root<Filter> quick = meeting(triangle, line).root(side);
  const int hit = within(quick, ray);
  if (hit == 0) return std::nullopt;
  const Contact contact{object, 0, value(quick)};
  if (hit == 1) return contact;
  const ExactRoot exact = root(contact, ray);
  if (within(exact, ray) == 0) return std::nullopt;
  return Contact{object, 0, rounded(exact)};
}

template <class Real>
std::optional<Contact> ExactContacts<Real>::first(std::uint32_t object, const Ray<Real>& ray) const {
  switch (geometry_.kind(object)) {
    case ObjectKind::triangle:
      return triangle_contact(object, ray);
    case ObjectKind::polygon:
      return filtered(object, [&]<class Number>() {
        const auto vertices = numbers<Number>(geometry_.polygon_vertices(object));
        const int axis = geometry_.polygon(object).dropped_axis;
        if constexpr (std::is_same_v<Number, Filter>)
          return find_in_polygon<Number>(ray, vertices, bounded_normal(object), axis);
        else
          return find_in_polygon<Number>(ray, vertices, newell_normal<Number>(vertices), axis);
      });
    case ObjectKind::sphere:
      return filtered(object,
                      [&]<class Number>() { return find_on_sphere<Number>(ray, geometry_.sphere(object)); });
    case ObjectKind::cone:
      return filtered(object, [&]<class Number>() {
        const bool outside_only = geometry_.cone_sides() == ConeSides::outside;
        return find_on_cone<Number>(ray, geometry_.cone(object), outside_only);
      });
    case ObjectKind::placed:
      break;
  }
  return std::nullopt;
}

template <class Real>
template <class Number>
Root<Number> ExactContacts<Real>::root(const Contact& contact, const Ray<Real>& ray) const {
  const Line<Number> line = line_of<Number>(ray);
  const std::uint32_t object = contact.object;
  switch (geometry_.kind(object)) {
    case ObjectKind::triangle:
      return meeting_root(meeting(geometry_.triangle(object), line));
    case ObjectKind::polygon: {
      const auto vertices = numbers<Number>(geometry_.polygon_vertices(object));
      return meeting_root(PlaneMeeting<Number>(line, newell_normal<Number>(vertices), vertices.front()));
    }
    case ObjectKind::sphere:
      return quadratic_of(line, geometry_.sphere(object)).root(1, contact.side);
    case ObjectKind::cone:
    case ObjectKind::placed:
      break;
  }
  const Quadratic<Number> quadratic = forms_of(line, geometry_.cone(object)).quadratic;
  if (contact.side == 0) return quadratic.linear_root(sign(quadratic.half_b) == -1 ? -1 : 1);
  return quadratic.root(sign(quadratic.a) == -1 ? -1 : 1, contact.side);
}

template <class Real>
int ExactContacts<Real>::compare(const Contact& a, const Contact& b, const Ray<Real>& ray) const {
  const int filtered = exact::compare(a.t, b.t);
  return filtered != kUnknown ? filtered : exact::compare(root(a, ray), root(b, ray));
}

template class ExactContacts<float>;
template class ExactContacts<double>;
template Root<Bounded<long double>> ExactContacts<double>::root(const Contact&, const Ray<double>&) const;

}  // namespace rayshoot::exact
