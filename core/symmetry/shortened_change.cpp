#include "core/symmetry/shortened_change.hpp"

#include <algorithm>

#include "core/expr/calculus.hpp"
#include "core/expr/simplify.hpp"

namespace qdot {
namespace {

bool is_constant(const Expression& e, const Symbols& symbols) {
  const Symbols::Varying& q = symbols.coordinates;
  return !depends_on(e, q.value) && !depends_on(e, q.rate) && !depends_on(e, symbols.t);
}

/// phi without what is the same wherever the coordinates are, and always.
Expression without_constant(const Expression& phi, const Symbols& symbols) {
  std::vector<Replacement> at_origin;
  for (const Expression& x : symbols.coordinates.value) at_origin.emplace_back(x, phi.graph().number(0));
  const Expression there = substitute(phi, at_origin);
  return is_constant(there, symbols) ? phi - there : phi;
}

}  // namespace

PointChange with_unit_of_time(const PointChange& change, const Symbols& symbols) {
  if (change.time.is_zero() || change.time.is_one()) return change;
  PointChange result{{}, change.time.graph().number(1), change.gauge};
  for (const Expression& shift : change.shift) result.shift.push_back(simplify(shift / change.time));
  result.gauge = simplify_by_degree(change.gauge / change.time, symbols);
  return result;
}

Expression gauge_on_constraints(const Expression& gauge, const Lagrangian& lagrangian) {
  const Symbols& symbols = lagrangian.symbols;
  Expression best = gauge;
  for (const ConstraintEquation& constraint : lagrangian.constraints) {
    if (!constraint.position) continue;
    const Expression given = best;
    const Expression joined = simplify_by_degree(given, symbols);
    if (written_length(joined) < written_length(best)) best = joined;
    for (std::size_t i = 0; i < constraint.slope.size(); ++i) {
      const Expression& slope = constraint.slope[i];
      const Expression own = differentiate(given, symbols.coordinates.value[i]);
      if (slope.is_zero() || own.is_zero() || !is_constant(slope, symbols)) continue;
      const Expression multiple = own / slope;
      const Expression& phi = *constraint.position;
      const Expression zero = is_constant(multiple, symbols) ? without_constant(phi, symbols) : phi;
      const Expression other = simplify_by_degree(given - multiple * zero, symbols);
      if (written_length(other) < written_length(best)) best = other;
    }
  }
  return best;
}

std::vector<Expression> integrals_of_constraints(const Lagrangian& lagrangian) {
  const Symbols& symbols = lagrangian.symbols;
  std::vector<Expression> integrals;
  for (const ConstraintEquation& constraint : lagrangian.constraints) {
    if (constraint.position) continue;
    std::vector<Expression> terms;
    Expression drift = constraint.rate;
    for (std::size_t i = 0; i < constraint.slope.size(); ++i) {
      terms.push_back(constraint.slope[i] * symbols.coordinates.value[i]);
      drift = drift - constraint.slope[i] * symbols.coordinates.rate[i];
    }
    drift = simplify(drift);
    const auto constant = [&](const Expression& e) { return is_constant(e, symbols); };
    if (!constant(drift) || !std::ranges::all_of(constraint.slope, constant)) continue;
    terms.push_back(drift * symbols.t);
    integrals.push_back(lagrangian.graph->sum(terms));
  }
  return integrals;
}

bool is_multiple(const Expression& a, const Expression& b, const Symbols& symbols) {
  for (const auto* group : {&symbols.coordinates.rate, &symbols.coordinates.value}) {
    for (const Expression& x : *group) {
      const Expression of_a = differentiate(a, x), of_b = differentiate(b, x);
      if (of_a.is_zero() != of_b.is_zero()) return false;
      if (of_a.is_zero()) continue;
      const Expression ratio = simplify(of_a / of_b);
      return is_constant(ratio, symbols) && simplify(a - ratio * b).is_zero();
    }
  }
  return false;
}

}  // namespace qdot
