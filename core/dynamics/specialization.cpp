#include "core/dynamics/specialization.hpp"

#include "core/dynamics/motion_functions.hpp"

namespace qdot {
namespace {

/// The inputs and the zeros, for expressions of `own`, a copy of the model's Lagrangian.
std::vector<Replacement> replacements_in(const Lagrangian& own, const Model& model, const InputTexts& inputs,
                                         const Vanishing& vanishing) {
  std::vector<Replacement> replacements = input_replacements(model, inputs, *own.graph);
  for (std::size_t i = 0; i < vanishing.size(); ++i) {
    if (!vanishing[i]) continue;
    const Replacement zero{own.symbols.parameters[i], own.graph->number(0)};
    for (Replacement& input : replacements) input.second = substitute(input.second, {&zero, 1});
    replacements.push_back(zero);
  }
  return replacements;
}

}  // namespace

Vanishing vanishing_among(const Reals& parameters) {
  Vanishing vanishing;
  for (std::size_t i = 0; i < parameters.size(); ++i) vanishing.push_back(parameters.exact(i) == Real(0));
  return vanishing;
}

Lagrangian specialized(const Model& model, const InputTexts& inputs, const Vanishing& vanishing) {
  const Lagrangian own = copied(model.lagrangian);
  return replaced(own, replacements_in(own, model, inputs, vanishing));
}

Conserved derive_conserved(const Model& model, const InputTexts& inputs, const Vanishing& vanishing) {
  const Lagrangian lagrangian = specialized(model, inputs, vanishing);
  Conserved result{conserved_quantities(lagrangian, model.scene), nullptr};
  std::vector<Expression> expressions;
  for (const ConservedQuantity& quantity : result.quantities) expressions.push_back(quantity.value);
  result.values = std::make_shared<const CompiledFunction>(
      compiled_along_motion(model, inputs, *lagrangian.graph, expressions));
  return result;
}

Conserved derive_found(const Model& model, const InputTexts& inputs, const Vanishing& vanishing) {
  const Lagrangian own = copied(model.lagrangian);
  const std::vector<Replacement> replacements = replacements_in(own, model, inputs, vanishing);
  const Lagrangian lagrangian = replaced(own, replacements);
  FoundQuantities found =
      found_quantities(model, lagrangian, replacements, conserved_quantities(lagrangian, model.scene));
  std::vector<Expression> expressions;
  for (const ConservedQuantity& quantity : found.quantities) expressions.push_back(quantity.value);
  auto values = std::make_shared<const CompiledFunction>(
      compiled_along_motion(model, inputs, *found.graph, expressions));
  return {std::move(found.quantities), std::move(values)};
}

Statics derive_statics(const Model& model, const InputTexts& inputs, const Vanishing& vanishing) {
  const Lagrangian own = copied(model.lagrangian);
  const std::vector<Replacement> replacements = replacements_in(own, model, inputs, vanishing);
  std::vector<Expression> divided;
  for (const Equation& equation : model.equations.equations) {
    const Expression whole = own.graph->adopt(equation.left) - own.graph->adopt(equation.right);
    divided.push_back(substitute(whole, replacements));
  }
  return derive_statics(replaced(own, replacements), divided);
}

}  // namespace qdot
