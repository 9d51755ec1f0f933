#include "accel/algebra/composed.h"
#include "accel/algebra/define_composition.h"
#include "accel/algebra/expression.h"
#include "accel/algebra/parallel.h"
#include "accel/algebra/recursive.h"
#include "accel/core/define_technique.h"
#include "accel/core/registry.h"

namespace rayshoot {

namespace {

template <class Real>
std::unique_ptr<Optimizer<Real>> build(const Expression& expression, const OptimizerInput<Real>& input) {
  const auto part = [&](std::size_t number) -> BuildPart<Real> {
    return
        [&part = expression.parts[number]](const OptimizerInput<Real>& scene) { return build(part, scene); };
  };
  switch (expression.kind) {
    case Expression::Kind::technique:
      return expression.entry->build_optimizer(input, expression.arguments);
    case Expression::Kind::sequential:
      return sequential(input, part(0), part(1), sequential_config(expression.arguments));
    case Expression::Kind::parallel:
      return parallel(input, part(0), part(1));
    case Expression::Kind::recursive:
      return recursive(input, part(0), recursive_config(expression.arguments));
  }
  return nullptr;
}

template <class Real>
OptimizerInput<Real> scene_of(const EngineInput<Real>& input) {
  return {input.geometry, {}, input.sample};
}

/// The entry's builders, where `optimizer` builds what is composed.
template <class BuildComposed>
void set_builders(TechniqueEntry& entry, const BuildComposed& optimizer) {
  const auto engine =
      [optimizer]<class Real>(const EngineInput<Real>& input) -> std::unique_ptr<Engine<Real>> {
    return std::make_unique<TechniqueEngine<Composed<Real>>>(
        Composed<Real>(optimizer(scene_of(input), input.arguments), input.geometry.size()), input.geometry);
  };
  entry.build_float = engine, entry.build_double = engine;
  entry.optimizer_float = optimizer, entry.optimizer_double = optimizer;
  entry.composed = true;
}

/// The parameters of all parts with their values, named by the part's place in the expression: "2.density".
void collect(const Expression& expression, std::vector<Parameter>& parameters, int& place) {
  const std::string prefix = std::to_string(++place) + ".";
  for (Parameter parameter : expression.parameters()) {
    parameter.default_value = text_of(expression.arguments.values().at(parameter.name));
    parameter.name = prefix + parameter.name;
    parameters.push_back(std::move(parameter));
  }
  for (const Expression& part : expression.parts) collect(part, parameters, place);
}

/// Where queries are out of reach for the first technique that a ray meets, they are for the whole.
std::uint64_t max_practical_objects(const Expression& expression) {
  return expression.kind == Expression::Kind::technique ? expression.entry->info.max_practical_objects
                                                        : max_practical_objects(expression.parts[0]);
}

}  // namespace

Arguments configuration(const Expression& expression) {
  std::vector<Parameter> parameters;
  int place = 0;
  collect(expression, parameters, place);
  return Arguments(parameters, {}, expression.text());
}

TechniqueEntry compose(const Expression& expression) {
  TechniqueEntry entry{.info = {.id = expression.text(),
                                .title = "Composition",
                                .family = "algebra",
                                .survey_section = "12",
                                .paper = "Revelles & Ureña",
                                .parameters = {},
                                .events = Composed<float>::events(expression.levels()),
                                .max_practical_objects = max_practical_objects(expression)},
                       .indexes_space = expression.indexes_space()};
  set_builders(entry, [expression]<class Real>(const OptimizerInput<Real>& input, const Arguments&) {
    return build(expression, input);
  });
  return entry;
}

TechniqueEntry define_composition(
    TechniqueInfo info, std::size_t levels,
    const std::function<std::string(const Arguments&, std::uint32_t objects)>& expression) {
  info.events = Composed<float>::events(levels);
  TechniqueEntry entry{.info = std::move(info)};
  set_builders(entry, [expression]<class Real>(const OptimizerInput<Real>& input,
                                               const Arguments& arguments) {
    return build(parse_expression(expression(arguments, input.geometry.size()), technique_entries()), input);
  });
  return entry;
}

}  // namespace rayshoot
