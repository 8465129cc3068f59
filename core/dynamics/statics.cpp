#include "core/dynamics/statics.hpp"

#include "core/base/error.hpp"
#include "core/compile/tape_builder.hpp"
#include "core/expr/kept_terms.hpp"
#include "core/expr/simplify.hpp"

namespace qdot {
namespace {

/// de_i/dv_j at rest, by rows.
std::vector<Expression> derivatives(const Reduction& reduction, const std::vector<Expression>& e,
                                    const std::vector<Expression>& variables) {
  std::vector<Expression> result;
  for (const Expression& row : e) {
    for (const Expression& v : variables) {
      result.push_back(simplify(at_rest(reduction, differentiate(row, v))));
    }
  }
  return result;
}

bool has_quadratic_energy(const Reduction& reduction) {
  for (const Expression& row : reduction.equations) {
    for (const Expression& acceleration : reduction.x_ddot) {
      const Expression entry = differentiate(row, acceleration);
      if (depends_on(entry, reduction.x_dot) && depends_on(simplify(entry), reduction.x_dot)) return false;
    }
  }
  return true;
}

/// M, K and D of Lagrange's equations for all coordinates, the ignored ones at their steady rates.
std::vector<Expression> linearized(const Lagrangian& lagrangian, const Reduction& reduction) {
  Graph& graph = *reduction.graph;
  const auto adopted = [&](const std::vector<Expression>& expressions) {
    std::vector<Expression> result;
    for (const Expression& e : expressions) result.push_back(graph.adopt(e));
    return result;
  };
  const Symbols::Varying& symbols = lagrangian.symbols.coordinates;
  const std::vector<Expression> q = adopted(symbols.value), q_dot = adopted(symbols.rate),
                                q_ddot = adopted(symbols.second_rate),
                                forces = adopted(lagrangian.generalized_forces);
  const Expression l = graph.adopt(lagrangian.lagrangian);
  std::vector<Replacement> rates{{graph.adopt(lagrangian.symbols.t), graph.number(1)}}, steady, unaccelerated;
  for (std::size_t i = 0; i < q.size(); ++i) {
    rates.emplace_back(q[i], q_dot[i]);
    rates.emplace_back(q_dot[i], q_ddot[i]);
    unaccelerated.emplace_back(q_ddot[i], graph.number(0));
  }
  for (std::size_t c = 0; c < reduction.ignored.size(); ++c) {
    steady.emplace_back(q_dot[reduction.ignored[c]], reduction.ignored_rates[c]);
  }
  std::vector<Expression> equations;
  for (std::size_t i = 0; i < q.size(); ++i) {
    const Expression change = total_derivative(differentiate(l, q_dot[i]), rates);
    equations.push_back(change - differentiate(l, q[i]) - forces[i]);
  }
  std::vector<Expression> result;
  for (const auto* variables : {&q_ddot, &q, &q_dot}) {
    for (const Expression& equation : equations) {
      for (const Expression& v : *variables) {
        const Expression e = substitute(differentiate(equation, v), unaccelerated);
        result.push_back(simplify(at_rest(reduction, substitute(e, steady))));
      }
    }
  }
  return result;
}

}  // namespace

CompiledFunction compiled_at_rest(const Reduction& reduction, Graph& graph,
                                  std::span<const Expression> expressions) {
  std::vector<Expression> constants, variables;
  for (const Expression& c : reduction.constants) constants.push_back(graph.adopt(c));
  for (const Expression& x : reduction.x) variables.push_back(graph.adopt(x));
  TapeBuilder tape(graph, constants, graph.symbol("t"), variables);
  for (const Expression& e : expressions) tape.output(e);
  return tape.finish();
}

Statics derive_statics(const Lagrangian& lagrangian, const std::vector<Expression>& divided) {
  Statics statics = statics_of(derive_reduction(lagrangian, divided));
  const Reduction& reduction = statics.reduction;
  if (!reduction.ignored.empty())
    statics.linearized = compiled_at_rest(reduction, *reduction.graph, linearized(lagrangian, reduction));
  return statics;
}

Statics statics_of(Reduction of) {
  Statics statics{std::move(of), {}, {}, {}, {}, {}, {}, {}, {}};
  const Reduction& reduction = statics.reduction;
  if (!reduction.autonomous) {
    throw Error(
        ErrorCode::not_applicable,
        "The time enters the equations of motion: where a system rests, and which frequencies small motions "
        "have, is answered only where it does not.");
  }
  const auto compiled = [&](const std::vector<Expression>& expressions) {
    return compiled_at_rest(reduction, *reduction.graph, expressions);
  };
  for (const Expression& e : reduction.equations) statics.rest.push_back(simplify(at_rest(reduction, e)));
  statics.forces = compiled(reduction.forces_at_rest);
  std::vector<Expression> stiffness;
  for (const Expression& force : reduction.forces_at_rest) {
    for (const Expression& x : reduction.x) stiffness.push_back(shortened_derivative(force, x));
  }
  statics.stiffness = compiled(stiffness);
  statics.inertia = compiled(derivatives(reduction, reduction.equations, reduction.x_ddot));
  statics.damping = compiled(derivatives(reduction, reduction.equations, reduction.x_dot));
  std::vector<Expression> rates;
  for (const Expression& rate : reduction.ignored_rates) rates.push_back(at_rest(reduction, rate));
  statics.ignored_rates = compiled(rates);
  if (reduction.conservative) {
    const Expression potential = Number(-1) * at_rest(reduction, reduction.routhian);
    statics.potential = compiled(
        {loses_digits_multiplied_out(potential) ? shortened(potential) : shortened_beside_kinks(potential)});
  }
  statics.quadratic = has_quadratic_energy(reduction);
  return statics;
}

}  // namespace qdot
