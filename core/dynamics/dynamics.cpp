#include "core/dynamics/dynamics.hpp"

#include <cmath>

namespace qdot {
namespace {

[[noreturn]] void no_statics(const Model& model) {
  std::string names;
  for (const Constraint& c : model.scene.constraints) names += (names.empty() ? "'" : ", '") + c.name + "'";
  throw Error(
      ErrorCode::not_applicable,
      "This is undetermined, as the scene has constraints (" + names +
          "). Ask simulate, energy, modes, equations, bifurcations or equilibria, or write the scene in coordinates "
          "that need none.");
}

}  // namespace

Dynamics::Dynamics(std::shared_ptr<const Model> model, InputTexts inputs, ExponentValues exponents)
    : model_(std::move(model)), inputs_(std::move(inputs)), exponents_(std::move(exponents)) {
  if (!inputs_.empty()) (void)accelerations();  // an input that does not parse is refused now
}

const CompiledFunction& Dynamics::accelerations() const {
  return accelerations_.get({}, [&] { return accelerations_of(*model_, inputs_); });
}

const CompiledFunction& Dynamics::jacobian() const {
  return jacobian_.get({}, [&] { return jacobian_of(*model_, inputs_); });
}

const CanonicalFunctions* Dynamics::canonical() const {
  if (model_->has_constraints()) return nullptr;
  return canonical_.get({}, [&] { return canonical_functions(specialized(*model_, inputs_, {})); }).get();
}

const ConstraintSurface* Dynamics::constraint_surface() const {
  if (!model_->has_constraints()) return nullptr;
  return constraint_surface_
      .get({}, [&] { return std::make_unique<const ConstraintSurface>(*model_, inputs_); })
      .get();
}

const Kinks* Dynamics::kinks() const {
  return kinks_.get({}, [&] { return kinks_of(*model_, inputs_); }).get();
}

std::shared_ptr<const KinkedMotion> Dynamics::kinked(const Staying& staying) const {
  return kinked_.get(staying, [&] { return kinked_motion(*model_, inputs_, staying); });
}

const CompiledFunction& Dynamics::kinked_jacobian(const Staying& staying) const {
  return kinked_jacobian_.get(staying, [&] { return jacobian_of(*model_, inputs_, &staying); });
}

std::shared_ptr<const CompiledFunction> Dynamics::columns(const std::vector<Column>& columns,
                                                          const Staying* staying) const {
  std::vector<NodeId> key;
  std::vector<Expression> expressions;
  for (const Column& column : columns) {
    key.push_back(column.value.id());
    expressions.push_back(column.value);
  }
  const auto on = staying == nullptr ? std::nullopt : std::optional(*staying);
  return columns_.get({key, on}, [&] {
    return std::make_shared<const CompiledFunction>(
        compiled_along_motion(*model_, inputs_, *model_->parsed.graph, expressions, staying));
  });
}

std::shared_ptr<const CompiledFunction> Dynamics::by_accelerations(const Expression& column) const {
  return by_accelerations_.get(column.id(), [&]() -> std::shared_ptr<const CompiledFunction> {
    auto function = compiled_by_accelerations(*model_, inputs_, *model_->parsed.graph, column);
    return function ? std::make_shared<const CompiledFunction>(std::move(*function)) : nullptr;
  });
}

std::shared_ptr<const Conserved> Dynamics::conserved(const Reals& parameters) const {
  const Vanishing vanishing = vanishing_among(parameters);
  return conserved_.get(vanishing, [&] {
    return std::make_shared<const Conserved>(derive_conserved(*model_, inputs_, vanishing));
  });
}

std::shared_ptr<const Conserved> Dynamics::found(const Reals& parameters) const {
  const Vanishing vanishing = vanishing_among(parameters);
  return found_.get(vanishing, [&] {
    return std::make_shared<const Conserved>(derive_found(*model_, inputs_, vanishing));
  });
}

std::shared_ptr<const Statics> Dynamics::statics(const Reals& parameters) const {
  if (model_->has_constraints()) no_statics(*model_);
  const Vanishing vanishing = vanishing_among(parameters);
  return statics_.get(vanishing, [&] {
    return std::make_shared<const Statics>(derive_statics(*model_, inputs_, vanishing));
  });
}

CompiledEvent Dynamics::event(const std::string& text, const Staying* staying) const {
  return compiled_event(*model_, inputs_, text, exponents_, staying);
}

CompiledFunction Dynamics::compiled(const Graph& graph, std::span<const Expression> expressions) const {
  return compiled_along_motion(*model_, inputs_, graph, expressions);
}

std::vector<double> values_at(const Dynamics& dynamics, const std::vector<Column>& columns,
                              std::span<const double> parameters, double t, std::span<const double> y) {
  return values_at(*dynamics.columns(columns), columns, parameters, t, y);
}

std::vector<double> values_at(const CompiledFunction& function, const std::vector<Column>& columns,
                              std::span<const double> parameters, double t, std::span<const double> y) {
  Workspace workspace = function.bind(parameters);
  std::vector<double> values(columns.size());
  switch (function.evaluate(t, y, workspace, values)) {
    case Evaluation::ok:
      return values;
    case Evaluation::singular_mass:
      throw Error(ErrorCode::invalid_state, "The mass matrix has no inverse in this state.");
    case Evaluation::nonfinite:
      break;
  }
  std::string undefined;
  for (std::size_t i = 0; i < columns.size(); ++i) {
    if (!std::isfinite(values[i])) undefined += (undefined.empty() ? "" : ", ") + columns[i].name;
  }
  throw Error(ErrorCode::invalid_state, "In this state there is no finite value of " + undefined + ".");
}

}  // namespace qdot
