#include "core/dynamics/dynamics.hpp"

#include <cmath>

namespace qdot {

Dynamics::Dynamics(std::shared_ptr<const Model> model, InputTexts inputs)
    : model_(std::move(model)), inputs_(std::move(inputs)) {
  if (!inputs_.empty()) (void)accelerations();  // an input that does not parse is refused now
}

const CompiledFunction& Dynamics::accelerations() const {
  return accelerations_.get({}, [&] { return accelerations_of(*model_, inputs_); });
}

const CompiledFunction& Dynamics::jacobian() const {
  return jacobian_.get({}, [&] { return jacobian_of(*model_, inputs_); });
}

const CanonicalFunctions* Dynamics::canonical() const {
  return canonical_.get({}, [&] { return canonical_functions(specialized(*model_, inputs_, {})); }).get();
}

std::shared_ptr<const CompiledFunction> Dynamics::columns(const std::vector<Column>& columns) const {
  std::vector<NodeId> key;
  std::vector<Expression> expressions;
  for (const Column& column : columns) {
    key.push_back(column.value.id());
    expressions.push_back(column.value);
  }
  return columns_.get(key, [&] {
    return std::make_shared<const CompiledFunction>(compiled(*model_->parsed.graph, expressions));
  });
}

std::shared_ptr<const Conserved> Dynamics::conserved(std::span<const double> parameters) const {
  const Vanishing vanishing = vanishing_among(parameters);
  return conserved_.get(vanishing, [&] {
    return std::make_shared<const Conserved>(derive_conserved(*model_, inputs_, vanishing));
  });
}

std::shared_ptr<const Statics> Dynamics::statics(std::span<const double> parameters) const {
  const Vanishing vanishing = vanishing_among(parameters);
  return statics_.get(vanishing, [&] {
    return std::make_shared<const Statics>(derive_statics(*model_, inputs_, vanishing));
  });
}

CompiledEvent Dynamics::event(const std::string& text) const {
  return compiled_event(*model_, inputs_, text);
}

CompiledFunction Dynamics::compiled(const Graph& graph, std::span<const Expression> expressions) const {
  return compiled_along_motion(*model_, inputs_, graph, expressions);
}

std::vector<double> values_at(const Dynamics& dynamics, const std::vector<Column>& columns,
                              std::span<const double> parameters, double t, std::span<const double> y) {
  const auto function = dynamics.columns(columns);
  Workspace workspace = function->bind(parameters);
  std::vector<double> values(columns.size());
  switch (function->evaluate(t, y, workspace, values)) {
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
