#include "core/mechanics/constraints.hpp"

#include "core/expr/polynomial.hpp"
#include "core/expr/simplify.hpp"
#include "core/mechanics/inertia_check.hpp"

namespace qdot {
namespace {

std::vector<Replacement> zeros(const std::vector<Expression>& symbols) {
  std::vector<Replacement> result;
  for (const Expression& symbol : symbols) result.emplace_back(symbol, symbol.graph().number(0));
  return result;
}

/// Rows are dependent where det(A A^T) = 0.
bool are_dependent(const std::vector<ConstraintEquation>& rows) {
  Matrix gram;
  for (const ConstraintEquation& a : rows) {
    gram.emplace_back();
    for (const ConstraintEquation& b : rows) {
      Expression sum = a.rate.graph().number(0);
      for (std::size_t i = 0; i < a.slope.size(); ++i) sum = sum + a.slope[i] * b.slope[i];
      gram.back().push_back(sum);
    }
  }
  return inertia_fault(gram).has_value();
}

}  // namespace

Expression slope_of(const ParsedConstraint& constraint, const Expression& x, const Expression& rate) {
  return differentiate(constraint.expression, constraint.holonomic ? x : rate);
}

std::vector<ConstraintEquation> constraint_equations(const ParsedScene& scene,
                                                     std::span<const Replacement> holding) {
  const Symbols& symbols = scene.symbols;
  const std::vector<Replacement> rates = symbols.rates();
  const std::vector<Replacement> at_rest = zeros(symbols.coordinates.second_rate);
  std::vector<ConstraintEquation> result;
  for (const ParsedConstraint& constraint : scene.constraints) {
    const Expression& e = constraint.expression;
    const Expression w = constraint.holonomic ? total_derivative(e, rates) : e;
    ConstraintEquation equation{
        .position = std::nullopt,
        .rate = simplify(substitute(w, holding)),
        .slope = {},
        .rest = simplify(substitute(substitute(total_derivative(w, rates), at_rest), holding))};
    if (constraint.holonomic) equation.position = substitute(e, holding);
    for (const Expression& rate : symbols.coordinates.rate)
      equation.slope.push_back(simplify(substitute(differentiate(w, rate), holding)));
    result.push_back(std::move(equation));
  }
  return result;
}

bool is_workless(const ConstraintEquation& constraint, const Symbols& symbols) {
  return simplify(substitute(constraint.rate, zeros(symbols.coordinates.rate))).is_zero();
}

std::optional<RedundantConstraint> redundant_constraint(const std::vector<ConstraintEquation>& constraints) {
  for (std::size_t k = 0; k < constraints.size(); ++k) {
    const auto end = constraints.begin() + static_cast<std::ptrdiff_t>(k) + 1;
    if (!are_dependent({constraints.begin(), end})) continue;
    for (std::size_t i = 0; i < k; ++i) {
      if (are_dependent({constraints[i], constraints[k]})) return RedundantConstraint{k, i};
    }
    return RedundantConstraint{k, std::nullopt};
  }
  return std::nullopt;
}

std::vector<Replacement> held_by_constraints(const std::vector<ConstraintEquation>& constraints,
                                             const Symbols& symbols) {
  const Symbols::Varying& q = symbols.coordinates;
  std::vector<Replacement> held;
  for (const ConstraintEquation& constraint : constraints) {
    for (std::size_t i = 0; constraint.position && i < q.value.size(); ++i) {
      const Number* slope = constraint.slope[i].number();
      if (slope == nullptr || slope->is_zero()) continue;
      const Number factor = Number(-1) / *slope;
      const Expression place = factor * expand(*constraint.position - constraint.slope[i] * q.value[i]);
      const bool moves = depends_on(place, symbols.t) || depends_on(place, symbols.inputs.value);
      if (moves || depends_on(place, q.value)) continue;
      held.emplace_back(q.value[i], place);
      held.emplace_back(q.rate[i], place.graph().number(0));
    }
  }
  return held;
}

}  // namespace qdot
