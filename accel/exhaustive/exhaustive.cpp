// Exhaustive search (Arvo & Kirk §2; the null optimizer of Revelles & Ureña, C_n = s)
//
// Idea       Test every object for every ray. There is nothing to build and nothing to get wrong, which makes
//            it the oracle that every other technique must equal.
// Parameters none.
// Cost       n object tests per ray, M = 1; equation (3) with a root volume that is never tested.
// Weak       always, beyond a few dozen objects.

#include "accel/core/define_technique.h"

namespace rayshoot {

namespace {

template <class Real>
class Exhaustive {
 public:
  using Scalar = Real;
  struct Config {};
  struct Scratch {};

  static TechniqueInfo info() {
    return {.id = "exhaustive",
            .title = "Exhaustive search",
            .family = "exhaustive",
            .survey_section = "2",
            .paper = "Arvo & Kirk 1989; Revelles & Ureña's null optimizer",
            .parameters = {},
            .max_practical_objects = 20'000};
  }
  static Config configure(const Arguments&) { return {}; }
  static Exhaustive build(const BuildInput<Real>& in, const Config&) {
    Exhaustive technique;
    technique.objects_ = in.geometry.size();
    technique.bounds_ = in.geometry.bounds();
    return technique;
  }

  Scratch scratch() const { return {}; }

  /// Hand every object to the leaf, in scene order.
  template <class Counter, class L>
  void visit(const Ray<Real>&, Scratch&, Counter, L& leaf) const {
    for (std::uint32_t object = 0; object < objects_; ++object)
      if (leaf(object)) return;
  }

  StructureStats structure() const { return {.nodes = 1, .leaves = 1, .references = objects_}; }
  Prediction<Real> predicted() const { return {static_cast<double>(objects_), 0, bounds_}; }

 private:
  std::uint32_t objects_ = 0;
  Box<Real> bounds_;
};

}  // namespace

RAYSHOOT_TECHNIQUE(exhaustive, Exhaustive)

}  // namespace rayshoot
