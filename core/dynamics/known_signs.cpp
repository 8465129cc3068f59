#include "core/dynamics/known_signs.hpp"

#include <algorithm>
#include <cmath>

#include "core/expr/calculus.hpp"

namespace qdot {
namespace {

std::vector<NodeId> roots_of(const Model& model, const std::vector<Column>& columns) {
  std::vector<NodeId> roots{model.lagrangian.lagrangian.id()};
  for (const Column& column : columns) roots.push_back(column.value.id());
  for (const Expression& e : model.equations.forcing) roots.push_back(e.id());
  for (const auto* matrix : {&model.equations.mass_matrix, &model.equations.reactions}) {
    for (const auto& row : *matrix) {
      for (const Expression& entry : row) roots.push_back(entry.id());
    }
  }
  for (const auto& [held, value] : model.lagrangian.holding) roots.push_back(value.id());
  return roots;
}

std::vector<RealAssignment> assigned(const Symbols& symbols, const Reals& parameters, double t,
                                     const Reals& y) {
  std::vector<RealAssignment> values{{symbols.t, Real(t)}};
  for (std::size_t i = 0; i < symbols.parameters.size(); ++i)
    values.emplace_back(symbols.parameters[i], parameters.exact(i));
  const std::size_t n = symbols.coordinates.value.size();
  for (std::size_t i = 0; i < n; ++i) {
    values.emplace_back(symbols.coordinates.value[i], y.exact(i));
    values.emplace_back(symbols.coordinates.rate[i], y.exact(n + i));
  }
  return values;
}

}  // namespace

bool signs_are_known(const Model& model, const std::vector<Column>& columns, const Reals& parameters,
                     double t, const Reals& y) {
  Graph& graph = *model.parsed.graph;
  const std::vector<RealAssignment> values = assigned(model.parsed.symbols, parameters, t, y);
  return std::ranges::all_of(reachable(graph, roots_of(model, columns)), [&](NodeId id) {
    const auto* call = std::get_if<Call>(&graph.node(id));
    if (call == nullptr || (call->function != Function::abs && call->function != Function::sign)) return true;
    const Real u = evaluate_exactly({graph, call->argument}, values);
    return u.is_finite() && std::abs(u.value) > std::abs(u.low) + u.error;
  });
}

}  // namespace qdot
