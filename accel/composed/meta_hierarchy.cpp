// Meta-hierarchies: a technique as an object of another technique
// J. Arvo & D. Kirk, "A survey of ray tracing acceleration techniques", 1989, §12; D. Kirk & J. Arvo, "The ray tracing kernel",
// 1988.
//
// Idea       What a technique needs to know of an object is how to bound it and how to find where a ray meets it; a technique
//            can answer both. So the parts of a scene that are placed in it are each searched by one technique, and the scene
//            that they are placed in by another, which takes them for objects.
// Parameters outer (bvh_sah)  of the whole scene: any technique of the algebra, or an expression. Placed parts differ in size
//                             and overlap, which suits a hierarchy
//            inner (bvh_sah)  of every part, at any depth
// Cost       that of the outer technique, and for each placed part whose box a ray meets that of the inner one.
// Weak       where nothing is placed it is the outer technique. Other techniques search placed parts as well: as outer and inner
//            one.

#include "accel/algebra/composed.h"
#include "accel/algebra/expression.h"
#include "accel/algebra/in_parts.h"
#include "accel/core/registry.h"

namespace rayshoot {

namespace {

TechniqueEntry technique_of(const std::string& text) {
  return compose(parse_expression(text, technique_entries()));
}

template <class Real>
std::unique_ptr<Engine<Real>> build(const EngineInput<Real>& input) {
  const TechniqueEntry outer = technique_of(input.arguments.text("outer")),
                       inner = technique_of(input.arguments.text("inner"));
  const BuildLevel<Real> level = [&](const OptimizerInput<Real>& scene, bool whole) {
    return (whole ? outer : inner).build_optimizer<Real>(scene, {});
  };
  return engine_in_parts(input, level, true);
}

}  // namespace

const TechniqueEntry& technique_meta_hierarchy() {
  static const TechniqueEntry entry{
      .info = {.id = "meta_hierarchy",
               .title = "A technique whose objects are searched by another one",
               .family = "composed",
               .survey_section = "12",
               .paper = "Kirk & Arvo 1988",
               .parameters = {text_parameter("outer", "bvh_sah",
                                             "technique or expression for the scene as a whole"),
                              text_parameter("inner", "bvh_sah",
                                             "technique or expression for each placed part")},
               .events = Composed<float>::events(LevelWork::kMostLevels)},
      .build_float = build<float>,
      .build_double = build<double>,
      .builds_parts = true};
  return entry;
}

}  // namespace rayshoot
