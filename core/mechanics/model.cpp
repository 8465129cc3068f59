#include "core/mechanics/model.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <optional>
#include <utility>

#include "core/expr/exact_number.hpp"
#include "core/expr/simplify.hpp"
#include "core/expr/unfold.hpp"
#include "core/mechanics/impacts.hpp"
#include "core/mechanics/inertia_check.hpp"
#include "core/mechanics/jumps.hpp"
#include "core/mechanics/negative_inertia.hpp"
#include "core/mechanics/reaction_sizes.hpp"

namespace qdot {
namespace {

std::string summary(const std::vector<Diagnostic>& diagnostics) {
  std::string text;
  for (const Diagnostic& d : diagnostics) text += (text.empty() ? "" : "\n") + d.place + ": " + d.message;
  return text;
}

/// An equation without any acceleration leaves its coordinate undetermined.
void check_inertia(const Scene& scene, const AugmentedSystem& system) {
  const auto fault = inertia_fault(system.matrix);
  if (!fault) return;
  std::vector<Diagnostic> diagnostics;
  for (const std::size_t i : fault->coordinates) {
    if (i >= scene.coordinates.size()) continue;
    diagnostics.push_back({"/coordinates/" + std::to_string(i), "no_inertia",
                           "Nothing that has mass moves with '" + scene.coordinates[i].name +
                               "', so its acceleration is undetermined."});
  }
  if (diagnostics.empty()) {
    diagnostics.push_back(
        {"/coordinates", "no_inertia",
         "The kinetic energy does not determine all accelerations: the mass matrix is singular everywhere."});
  }
  throw SceneError(diagnostics);
}

/// A constraint that follows from others, or speaks against them, leaves its force undetermined.
void check_constraints(const Scene& scene, const Lagrangian& lagrangian) {
  const auto found = redundant_constraint(lagrangian.constraints);
  if (!found) return;
  const std::string& name = scene.constraints[found->constraint].name;
  const std::string place = "/constraints/" + std::to_string(found->constraint);
  const auto is_zero = [](const Expression& slope) { return simplify(slope).is_zero(); };
  if (std::ranges::all_of(lagrangian.constraints[found->constraint].slope, is_zero)) {
    throw SceneError({{place, "redundant",
                       "The constraint '" + name +
                           "' says nothing of the velocities, whatever they are, so that it has no force. "
                           "Leave it out."}});
  }
  const std::string others =
      found->repeats ? "'" + scene.constraints[*found->repeats].name + "'" : "those before it";
  throw SceneError({{place, "redundant",
                     "The constraint '" + name + "' repeats or contradicts " + others +
                         ": what it says of the velocities follows from them, so its force is undetermined. "
                         "Leave one of them out."}});
}

void derive_impacts(Model& model) {
  for (ParsedImpact& impact : model.parsed.impacts) {
    if (!impact.contact) continue;
    Expression& distance = impact.contact->distance;
    distance = substitute(distance, model.lagrangian.holding);
    impact.contact->rate = total_derivative(distance, model.parsed.symbols.rates());
    try {
      impact.map = derived_impact(model.parsed, *impact.contact, model.lagrangian);
    } catch (const Error& error) {
      if (error.code() != ErrorCode::not_applicable) throw;
      throw SceneError({{impact.place, "not_applicable", error.what()}});
    }
  }
}

Expression quantity_of(const Scene& scene, const Lagrangian& lagrangian, const ParsedCondition& condition,
                       const std::string& place) {
  if (const auto* which = std::get_if<ParsedReaction>(&condition)) {
    Expression found = reaction(lagrangian, *which);
    if (!found.is_zero()) return found;
    throw SceneError(
        {{place + "/reaction/length", "no_reaction",
          "The reaction of '" + scene.held_lengths[which->held].name +
              "' is 0 always: write the held length where it stands in the scene, as in the place of "
              "what it holds."}});
  }
  return substitute(std::get<Expression>(condition), lagrangian.holding);
}

}  // namespace

SceneError::SceneError(std::vector<Diagnostic> diagnostics)
    : Error(ErrorCode::invalid_scene, summary(diagnostics)), diagnostics_(std::move(diagnostics)) {}

std::shared_ptr<const Model> build_model(const Scene& scene, const ExponentValues& exponents,
                                         const Followers& followers) {
  std::vector<Diagnostic> diagnostics;
  ParsedScene parsed = parse_scene(scene, diagnostics, exponents, followers);
  if (diagnostics.empty()) diagnostics = write_sizes_of_reactions(scene, parsed);
  if (!diagnostics.empty()) throw SceneError(diagnostics);
  auto model = std::make_shared<Model>();
  model->scene = scene;
  model->parsed = std::move(parsed);
  model->lagrangian = derive_lagrangian(model->parsed);
  model->equations = derive_equations(model->lagrangian);
  check_constraints(scene, model->lagrangian);
  model->system = augmented(model->equations, model->lagrangian);
  check_inertia(scene, model->system);
  if (auto negative = negative_inertia(scene, model->parsed, model->lagrangian); !negative.empty())
    throw SceneError(std::move(negative));
  derive_impacts(*model);
  if (const auto& kinetic = model->lagrangian.kinetic_energy) {
    for (const int degree : {2, 1, 0}) {
      model->kinetic_parts.push_back(simplify(velocity_degree(*kinetic, model->parsed.symbols, degree)));
    }
  }
  if (model->lagrangian.kinetic_energy) {
    model->energy = *model->lagrangian.kinetic_energy + *model->lagrangian.potential_energy;
  }
  model->momenta = conjugate_momenta(model->lagrangian);
  model->jacobi = jacobi_integral(model->lagrangian);
  const auto quantities_of = [&](const std::vector<ParsedCondition>& conditions, const std::string& list) {
    std::vector<Expression> quantities;
    for (std::size_t i = 0; i < conditions.size(); ++i)
      quantities.push_back(quantity_of(scene, model->lagrangian, conditions[i], list + std::to_string(i)));
    return quantities;
  };
  for (const Expression& e : quantities_of(model->parsed.valid_while, "/valid_while/"))
    model->validity.push_back(with_squares_under_roots(e, model->parsed.symbols.coordinates.value));
  model->reports = quantities_of(model->parsed.reports, "/reports/");
  model->impulse = impulse_of_jumps(scene, model->lagrangian);
  model->partial = partial_quantities(model->parsed, model->lagrangian);
  model->lagrangian.graph->forget_brackets();  // a model lives long, and asks little of them
  return model;
}

namespace {

/// The rational number that a parameter is by its default, and of which `is_it` tells that it is that one.
class DefaultNumbers {
 public:
  using IsIt = std::function<bool(std::size_t parameter, const Number& number)>;
  DefaultNumbers(const Model& model, IsIt is_it) : model_(model), is_it_(std::move(is_it)) {}

  [[nodiscard]] std::optional<Number> of(const Expression& e) const {
    return exact_number(e, [this](const Expression& symbol) -> std::optional<Number> {
      const std::vector<Expression>& all = model_.parsed.symbols.parameters;
      const auto i = static_cast<std::size_t>(std::ranges::find(all, symbol) - all.begin());
      if (i == all.size()) return std::nullopt;
      const auto number = of(model_.parsed.parameter_defaults[i]);
      return number && is_it_(i, *number) ? number : std::nullopt;
    });
  }

 private:
  const Model& model_;
  IsIt is_it_;
};

Real value_of_default(const Expression& e, std::span<const RealAssignment> known,
                      const DefaultNumbers& numbers) {
  const Real value = evaluate_exactly(e, known);
  if (!value.has_lost_digits()) return value;
  const auto number = numbers.of(e);
  return number ? number->rounded() : value;
}

}  // namespace

Reals parameter_values(const Model& model, const RealValues& given) {
  const std::vector<Expression>& symbols = model.parsed.symbols.parameters;
  std::vector<std::optional<Real>> known(symbols.size());
  const DefaultNumbers numbers(model, [&](std::size_t i, const Number& number) {
    const Real* found = given.find(model.scene.parameters[i].name);
    return found == nullptr || *found == number.rounded();
  });
  const std::function<Real(std::size_t)> value_of = [&](std::size_t i) {
    if (known[i]) return *known[i];
    if (const Real* found = given.find(model.scene.parameters[i].name)) return *(known[i] = *found);
    const Expression& e = model.parsed.parameter_defaults[i];
    std::vector<RealAssignment> needed;
    for (std::size_t j = 0; j < symbols.size(); ++j) {
      if (depends_on(e, symbols[j])) needed.emplace_back(symbols[j], value_of(j));
    }
    return *(known[i] = value_of_default(e, needed, numbers));
  };
  Reals values;
  for (std::size_t i = 0; i < symbols.size(); ++i) values.push_back(value_of(i));
  return values;
}

Reals initial_state(const Model& model, const Reals& parameters, const RealValues& given) {
  std::vector<RealAssignment> known;
  for (std::size_t i = 0; i < parameters.size(); ++i) {
    known.emplace_back(model.parsed.symbols.parameters[i], parameters.exact(i));
  }
  const DefaultNumbers numbers(
      model, [&](std::size_t i, const Number& number) { return number.rounded() == parameters.exact(i); });
  Reals state;
  const auto append = [&](const std::string& name, const Expression& by_default) {
    const Real* found = given.find(name);
    state.push_back(found != nullptr ? *found : value_of_default(by_default, known, numbers));
  };
  for (std::size_t i = 0; i < model.degrees_of_freedom(); ++i) {
    append(model.scene.coordinates[i].name, model.parsed.initial[i]);
  }
  for (std::size_t i = 0; i < model.degrees_of_freedom(); ++i) {
    append(model.scene.coordinates[i].name + "_dot", model.parsed.initial_rates[i]);
  }
  return state;
}

}  // namespace qdot
