#include "core/mechanics/reduction.hpp"

#include <algorithm>

#include "core/expr/kept_terms.hpp"
#include "core/expr/polynomial.hpp"
#include "core/expr/simplify.hpp"
#include "core/mechanics/canonical.hpp"
#include "core/mechanics/explicit_time.hpp"

namespace qdot {
namespace {

/// Ignorable, and in no generalized force: forces on others may depend on where an ignorable coordinate is.
std::vector<std::size_t> removable_coordinates(const Lagrangian& lagrangian) {
  std::vector<std::size_t> found = ignorable_coordinates(lagrangian);
  const std::vector<Expression>& q = lagrangian.symbols.coordinates.value;
  std::erase_if(found, [&](std::size_t i) {
    return std::any_of(lagrangian.generalized_forces.begin(), lagrangian.generalized_forces.end(),
                       [&](const Expression& force) { return depends_on(force, q[i]); });
  });
  return found;
}

std::vector<Expression> chosen(const std::vector<Expression>& all, const std::vector<std::size_t>& places) {
  std::vector<Expression> result;
  for (const std::size_t i : places) result.push_back(all[i]);
  return result;
}

/// d/dt dR/dx_i' - dR/dx_i.
Expression lagrange(const Reduction& reduction, const Symbols& symbols, std::size_t i) {
  std::vector<Replacement> rates{{symbols.t, reduction.graph->number(1)}};
  for (std::size_t k = 0; k < reduction.x.size(); ++k) {
    rates.emplace_back(reduction.x[k], reduction.x_dot[k]);
    rates.emplace_back(reduction.x_dot[k], reduction.x_ddot[k]);
  }
  const Expression momentum = differentiate(reduction.routhian, reduction.x_dot[i]);
  return total_derivative(momentum, rates) - differentiate(reduction.routhian, reduction.x[i]);
}

/// Divided by the exponentials of the time that all terms share, which have no zero.
/// Source: Kanai, Prog. Theor. Phys. 3 (1948) 440.
Expression without_shared_growth(const Expression& equation, const Expression& t) {
  Graph& graph = equation.graph();
  const Polynomial terms = multiplied_out(equation);
  Monomial shared = common_monomial(terms);
  std::erase_if(shared, [&](const Atom& atom) {
    const auto* call = std::get_if<Call>(&graph.node(atom.base));
    return call == nullptr || call->function != Function::exp || !depends_on(Expression(graph, atom.base), t);
  });
  return shared.empty() ? equation
                        : simplify(to_expression(graph, scaled(terms, inverse(shared), Number(1))));
}

/// Takes such exponentials from all equations, where that leaves no time in them.
void take_out_growth(Reduction& reduction, const Expression& t) {
  std::vector<Expression> left;
  for (const Expression& e : reduction.equations) {
    left.push_back(depends_on(e, t) ? without_shared_growth(e, t) : e);
    if (depends_on(left.back(), t)) return;
  }
  reduction.equations = std::move(left);
  reduction.without_growth = reduction.autonomous = true;
  for (std::size_t k = 0; k < reduction.equations.size(); ++k)
    reduction.forces_at_rest[k] = simplify(at_rest(reduction, reduction.equations[k]));
}

Expression force_at_rest(const Reduction& reduction, std::size_t i, const Expression& force) {
  const Expression short_form = simplify(at_rest(reduction, reduction.equations[i]));
  const Expression written =
      at_rest(reduction, Number(-1) * differentiate(reduction.routhian, reduction.x[i]) - force);
  const bool is_same = loses_digits_multiplied_out(written) && simplify(written) == short_form;
  return is_same ? written : short_form;
}

}  // namespace

Reduction derive_reduction(const Lagrangian& lagrangian, const std::vector<Expression>& divided,
                           Ignorable ignorable) {
  Lagrangian own = copied(lagrangian);
  const Symbols::Varying& q = own.symbols.coordinates;
  Reduction result;
  result.graph = own.graph;
  result.constants = own.symbols.parameters;
  result.routhian = own.lagrangian;
  std::vector<Replacement> replacements;
  std::vector<std::size_t> removable;
  if (ignorable == Ignorable::taken_out) removable = removable_coordinates(own);
  if (!removable.empty()) {
    if (const auto routh = routhian(own); routh && routh->ignored == removable) {
      result.ignored = removable;
      result.routhian = routh->routhian;
      result.ignored_rates = routh->rates;
      const std::vector<Expression> p = momentum_symbols(own);
      for (std::size_t k = 0; k < removable.size(); ++k) {
        result.constants.push_back(p[removable[k]]);
        replacements.emplace_back(q.rate[removable[k]], routh->rates[k]);
      }
    }
  }
  for (std::size_t i = 0; i < q.value.size(); ++i) {
    if (std::find(result.ignored.begin(), result.ignored.end(), i) == result.ignored.end())
      result.kept.push_back(i);
  }
  result.x = chosen(q.value, result.kept);
  result.x_dot = chosen(q.rate, result.kept);
  result.x_ddot = chosen(q.second_rate, result.kept);
  if (const auto left = without_explicit_time(result.routhian, result.x, result.x_dot, own.symbols.t))
    result.routhian = simplify_by_degree(*left, own.symbols);
  result.autonomous = true;
  result.conservative = !depends_on(result.routhian, own.symbols.t);
  for (std::size_t k = 0; k < result.kept.size(); ++k) {
    const Expression force = substitute(own.generalized_forces[result.kept[k]], replacements);
    Expression equation = simplify(lagrange(result, own.symbols, k) - force);
    if (equation.is_zero() && result.kept[k] < divided.size()) {
      equation = simplify(substitute(own.graph->adopt(divided[result.kept[k]]), replacements));
      if (!equation.is_zero()) result.limits.push_back(result.kept[k]);
    }
    result.equations.push_back(equation);
    result.forces_at_rest.push_back(force_at_rest(result, k, force));
    result.conservative = result.conservative && force.is_zero();
    result.autonomous = result.autonomous && !depends_on(equation, own.symbols.t);
  }
  if (result.autonomous) return result;
  if (!result.ignored.empty()) {  // a constant momentum may hide what all equations share
    Reduction whole = derive_reduction(lagrangian, divided, Ignorable::kept);
    return whole.autonomous ? whole : result;
  }
  take_out_growth(result, own.symbols.t);
  return result;
}

Expression at_rest(const Reduction& reduction, const Expression& e) {
  std::vector<Replacement> rest;
  for (const auto* symbols : {&reduction.x_dot, &reduction.x_ddot}) {
    for (const Expression& symbol : *symbols) rest.emplace_back(symbol, reduction.graph->number(0));
  }
  return substitute(e, rest);
}

}  // namespace qdot
