#include "harness/verify/exact/find_root.h"
#include "harness/verify/exact/firm.h"

namespace rayshoot::exact {

namespace {

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
    result.require(condition(after(which, ray.t_max, inputs), -1));
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
  /// The height of a root above the base; and with how it moves, together with the root, which by Newton's step
  /// moves by f / f' as the coefficients of f do.
  void require_segment(std::size_t which, Conditions& conditions) const {
    const ExactRoot& root = quadratic.roots[which];
    const long double t = value(root);
    const auto& f = sensitive.quadratic;
    const Sensitive step = f.at(Sensitive(t)) * Sensitive(1 / (2 * (f.a.value * t + f.half_b.value)));
    const Sensitive height = sensitive.height_at_origin + sensitive.height_slope * (Sensitive(t) - step);
    const auto side_of = [&](const Dyadic& at_origin, const Sensitive& moving) {
      const int s = linear_sign(root, at_origin, exact.height_slope);
      return std::abs(moving.value) > moving.reach() ? s : kUnknown;
    };
    conditions.require(condition(side_of(exact.height_at_origin, height), 1));
    conditions.require(condition(
        side_of(exact.height_at_origin - exact.height_at_apex, height - sensitive.height_at_apex), -1));
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
Reading read_quadric(const ExactContacts<Real>& contacts, std::uint32_t object, const Ray<Real>& ray) {
  const bool is_sphere = contacts.geometry().kind(object) == ObjectKind::sphere;
  return is_sphere ? read_sphere(contacts, object, ray) : read_cone(contacts, object, ray);
}

template Reading read_quadric(const ExactContacts<float>&, std::uint32_t, const Ray<float>&);
template Reading read_quadric(const ExactContacts<double>&, std::uint32_t, const Ray<double>&);

}  // namespace rayshoot::exact
