#include "harness/verify/exact_oracle.h"

#include <algorithm>

#include "harness/verify/exact/bounds.h"
#include "harness/verify/exact/hierarchy.h"
#include "harness/verify/exact/reading.h"
#include "harness/verify/exact/sensitive.h"

namespace rayshoot {

using exact::Contact;
using exact::ExactContacts;
using exact::ExactRoot;
using exact::kUnknown;
using exact::Reading;

namespace {

/// An error bound this small, in ulps, is good enough for errors in ulps.
constexpr double kErrorOfUlps = 1e-3;

template <class Real>
std::vector<BoxedObject<double>> boxed(const ExactContacts<Real>& contacts) {
  std::vector<BoxedObject<double>> objects(contacts.geometry().size());
  for (std::uint32_t object = 0; object < objects.size(); ++object)
    objects[object] = {exact_bounds(contacts, object), object};
  return objects;
}

template <class Real>
double ulp_at(long double t) {
  const auto rounded =
      static_cast<Real>(std::min<long double>(std::abs(t), std::numeric_limits<Real>::max()));
  return static_cast<double>(exact::ulp(rounded));
}

/// Whether the root lies past the middle between t and a neighbour of it, which is upwards (1) or downwards (-1).
bool is_past_middle(const ExactRoot& root, double t, double neighbour, int upwards) {
  const exact::Dyadic twice_middle = exact::Dyadic(t) + exact::Dyadic(neighbour);
  return upwards * linear_sign(root, -twice_middle, exact::Dyadic(2)) > 0;
}

}  // namespace

template <class Real>
class ExactOracle<Real>::Search {
 public:
  Search(const Geometry<Real>& geometry, double near_ulps)
      : contacts_(geometry), hierarchy_(boxed(contacts_)), near_ulps_(near_ulps) {}

  Grade grade(const Ray<Real>& ray, const Hit<Real>& answer) const;
  ExactHit<Real> nearest(const Ray<Real>& ray) const;

 private:
  std::optional<Contact> nearest(const Ray<Real>& ray, const std::optional<Contact>& known) const;
  std::optional<long double> nearest_certain(const Ray<Real>& ray) const;
  AnswerClass classify(const Ray<Real>& ray, const Hit<Real>& answer,
                       const std::optional<Contact>& nearest) const;
  void measure(const Ray<Real>& ray, Real t, const Contact& contact, Grade& grade) const;
  double error(const Ray<Real>& ray, Real t, const Contact& contact, double ulp) const;
  Real rounded(const Contact& contact, const Ray<Real>& ray) const;

  static exact::SlabRay slabs(const Ray<Real>& ray) {
    return {Vec3d(ray.origin), Vec3d(ray.direction), static_cast<double>(ray.t_min)};
  }

  ExactContacts<Real> contacts_;
  exact::Hierarchy hierarchy_;
  double near_ulps_;
};

/// The nearest contact, or `known` where none is nearer.
template <class Real>
std::optional<Contact> ExactOracle<Real>::Search::nearest(const Ray<Real>& ray,
                                                          const std::optional<Contact>& known) const {
  std::optional<Contact> best = known;
  const auto reach = [&] { return best ? best->t.highest() : static_cast<double>(ray.t_max); };
  hierarchy_.visit(slabs(ray), reach(), [&](std::uint32_t object) {
    if (known && object == known->object) return reach();
    const auto contact = contacts_.first(object, ray);
    if (contact && (!best || contacts_.compare(*contact, *best, ray) < 0)) best = contact;
    return reach();
  });
  return best;
}

/// The nearest contact that half an ulp of the inputs does not undo.
template <class Real>
std::optional<long double> ExactOracle<Real>::Search::nearest_certain(const Ray<Real>& ray) const {
  std::optional<long double> best;
  double reach = ray.t_max;
  hierarchy_.visit(slabs(ray), reach, [&](std::uint32_t object) {
    const auto contact = contacts_.first(object, ray);
    if (!contact || contact->t.lowest() > reach) return reach;
    const Reading reading = exact::read(contacts_, object, ray);
    if (reading.certain && (!best || *reading.certain < *best)) {
      best = reading.certain;
      reach = std::nextafter(static_cast<double>(*best), std::numeric_limits<double>::infinity());
    }
    return reach;
  });
  return best;
}

/// The class of an answer that is not exactly right.
template <class Real>
AnswerClass ExactOracle<Real>::Search::classify(const Ray<Real>& ray, const Hit<Real>& answer,
                                                const std::optional<Contact>& nearest) const {
  const std::optional<long double> certain = nearest ? nearest_certain(ray) : std::nullopt;
  if (answer.object == kNoObject) return certain ? AnswerClass::false_miss : AnswerClass::ambiguous;
  if (answer.object < contacts_.geometry().size()) {
    const Reading reading = exact::read(contacts_, answer.object, ray);
    const auto within = [&](long double t, double ulps) {
      return *reading.possible <= t + ulps * ulp_at<Real>(t);
    };
    if (reading.possible && (!certain || within(*certain, kErrorOfUlps))) return AnswerClass::ambiguous;
    if (reading.possible && nearest && within(value(contacts_.root(*nearest, ray)), near_ulps_))
      return AnswerClass::near;
  }
  return nearest ? AnswerClass::wrong_object : AnswerClass::false_hit;
}

/// |t - exact t| in units of `ulp`.
template <class Real>
double ExactOracle<Real>::Search::error(const Ray<Real>& ray, Real t, const Contact& contact,
                                        double ulp) const {
  if (!std::isfinite(t)) return std::numeric_limits<double>::infinity();
  if (contact.t.error <= kErrorOfUlps * ulp) return std::abs(static_cast<double>(t) - contact.t.value) / ulp;
  if constexpr (std::is_same_v<Real, double>) {
    const auto wide = value(contacts_.template root<exact::Bounded<long double>>(contact, ray));
    if (wide.error <= kErrorOfUlps * ulp) return static_cast<double>(std::abs(t - wide.value) / ulp);
  }
  return static_cast<double>(std::abs(difference(contacts_.root(contact, ray), t)) / ulp);
}

template <class Real>
void ExactOracle<Real>::Search::measure(const Ray<Real>& ray, Real t, const Contact& contact,
                                        Grade& grade) const {
  const double ulp = ulp_at<Real>(contact.t.value);
  grade.ulps_of_t = error(ray, t, contact, ulp);
  const Box<Real> box = contacts_.geometry().bounds(contact.object);
  const double point_ulp = ulp_at<Real>(std::max(max_abs(box.lo), max_abs(box.hi)));
  grade.ulps_of_point = grade.ulps_of_t * (ulp / point_ulp) * static_cast<double>(max_abs(ray.direction));
  if (std::isnan(grade.ulps_of_point)) grade.ulps_of_point = std::numeric_limits<double>::infinity();
}

template <class Real>
Grade ExactOracle<Real>::Search::grade(const Ray<Real>& given, const Hit<Real>& answer) const {
  if (std::isnan(answer.t)) return {AnswerClass::not_a_number};
  const bool answered = answer.object != kNoObject;
  const auto usable = exact::usable(given);
  if (!usable) return {answered ? AnswerClass::false_hit : AnswerClass::exact};
  const Ray<Real>& ray = *usable;
  std::optional<Contact> own;
  if (answer.object < contacts_.geometry().size()) own = contacts_.first(answer.object, ray);
  const std::optional<Contact> best = nearest(ray, own);
  const bool right = answered ? own && best->object == own->object : !best;
  Grade grade{right ? AnswerClass::exact : classify(ray, answer, best)};
  if (answered && best) measure(ray, answer.t, own ? *own : *best, grade);
  return grade;
}

template <class Real>
Real ExactOracle<Real>::Search::rounded(const Contact& contact, const Ray<Real>& ray) const {
  const auto low = static_cast<Real>(contact.t.lowest()), high = static_cast<Real>(contact.t.highest());
  if (low == high) return low;
  const ExactRoot root = contacts_.root(contact, ray);
  auto t = static_cast<Real>(value(root));
  constexpr Real infinity = std::numeric_limits<Real>::infinity();
  while (is_past_middle(root, t, std::nextafter(t, infinity), 1)) t = std::nextafter(t, infinity);
  while (is_past_middle(root, t, std::nextafter(t, -infinity), -1)) t = std::nextafter(t, -infinity);
  return t;
}

template <class Real>
ExactHit<Real> ExactOracle<Real>::Search::nearest(const Ray<Real>& given) const {
  const auto usable = exact::usable(given);
  if (!usable) return {};
  const Ray<Real>& ray = *usable;
  std::optional<Contact> best;
  ExactHit<Real> hit;
  hierarchy_.visit(slabs(ray), ray.t_max, [&](std::uint32_t object) {
    const auto contact = contacts_.first(object, ray);
    const int order = !contact ? 1 : !best ? -1 : contacts_.compare(*contact, *best, ray);
    if (order < 0) hit.objects.clear(), best = contact;
    if (order <= 0) hit.objects.push_back(object);
    return best ? best->t.highest() : static_cast<double>(ray.t_max);
  });
  if (!best) return hit;
  std::sort(hit.objects.begin(), hit.objects.end());
  hit.t = rounded(*best, ray);
  const double same = best->t.value + kErrorOfUlps * ulp_at<Real>(best->t.value) + best->t.error;
  hit.borderline = std::none_of(hit.objects.begin(), hit.objects.end(), [&](std::uint32_t object) {
    const Reading reading = exact::read(contacts_, object, ray);
    return reading.certain && *reading.certain <= same;
  });
  return hit;
}

template <class Real>
ExactOracle<Real>::ExactOracle(const Geometry<Real>& geometry, double near_ulps)
    : search_(std::make_unique<const Search>(geometry, near_ulps)) {}
template <class Real>
ExactOracle<Real>::~ExactOracle() = default;
template <class Real>
ExactOracle<Real>::ExactOracle(ExactOracle&&) noexcept = default;

template <class Real>
Grade ExactOracle<Real>::grade(const Ray<Real>& ray, const Hit<Real>& answer) const {
  return search_->grade(ray, answer);
}
template <class Real>
ExactHit<Real> ExactOracle<Real>::nearest(const Ray<Real>& ray) const {
  return search_->nearest(ray);
}

template class ExactOracle<float>;
template class ExactOracle<double>;

}  // namespace rayshoot
