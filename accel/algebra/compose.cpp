#include "accel/algebra/composed.h"
#include "accel/algebra/expression.h"
#include "accel/algebra/parallel.h"
#include "accel/algebra/recursive.h"
#include "accel/core/define_technique.h"

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
  TechniqueEntry entry;
  entry.info = {.id = expression.text(),
                .title = "Composition",
                .family = "algebra",
                .survey_section = "12",
                .paper = "Revelles & Ureña",
                .parameters = {},
                .events = Composed<float>::events(expression.levels()),
                .max_practical_objects = max_practical_objects(expression)};
  const auto engine =
      [expression]<class Real>(const EngineInput<Real>& input) -> std::unique_ptr<Engine<Real>> {
    const OptimizerInput<Real> scene{input.geometry, {}, input.sample};
    return std::make_unique<TechniqueEngine<Composed<Real>>>(
        Composed<Real>(build(expression, scene), input.geometry.size()), input.geometry);
  };
  const auto optimizer = [expression]<class Real>(const OptimizerInput<Real>& input, const Arguments&) {
    return build(expression, input);
  };
  entry.build_float = engine, entry.build_double = engine;
  entry.optimizer_float = optimizer, entry.optimizer_double = optimizer;
  entry.indexes_space = expression.indexes_space();
  return entry;
}

}  // namespace rayshoot
