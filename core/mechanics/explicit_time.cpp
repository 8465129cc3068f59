#include "core/mechanics/explicit_time.hpp"

#include <algorithm>

#include "core/expr/calculus.hpp"
#include "core/expr/polynomial.hpp"
#include "core/expr/simplify.hpp"

namespace qdot {
namespace {

/// Of f(k x + c) by x, for an elementary f.
std::optional<Expression> call_integral(const Expression& e, const Expression& x) {
  const auto& call = std::get<Call>(e.node());
  const Expression argument(e.graph(), call.argument), slope = simplify(differentiate(argument, x));
  if (slope.is_zero() || depends_on(slope, x)) return std::nullopt;
  switch (call.function) {
    case Function::sin:
      return -cos(argument) / slope;
    case Function::cos:
      return sin(argument) / slope;
    case Function::exp:
      return e / slope;
    default:
      return std::nullopt;
  }
}

/// Of a term in which one factor at most depends on x.
std::optional<Expression> term_integral(Graph& graph, const Monomial& term, const Expression& x) {
  Expression front = graph.number(1);
  std::optional<Expression> integral;
  for (const Atom& atom : term) {
    const Expression base(graph, atom.base), factor = pow(base, Number::ratio(atom.p, atom.q));
    if (!depends_on(base, x)) {
      front = front * factor;
      continue;
    }
    if (integral) return std::nullopt;
    const bool is_power = base == x && atom.q == 1 && atom.p > 0;
    const bool is_call = std::holds_alternative<Call>(base.node()) && atom.p == 1 && atom.q == 1;
    if (is_power) integral = Number::ratio(1, atom.p + 1) * pow(x, Number(atom.p + 1));
    if (is_call) integral = call_integral(base, x);
    if (!integral) return std::nullopt;
  }
  return front * integral.value_or(x);
}

std::optional<Expression> integral_of(const Expression& e, const Expression& x) {
  Graph& graph = e.graph();
  Expression sum = graph.number(0);
  for (const auto& [term, coefficient] : multiplied_out(e)) {
    const auto part = term_integral(graph, term, x);
    if (!part) return std::nullopt;
    sum = sum + coefficient * *part;
  }
  return sum;
}

/// The terms that the time is in.
Expression part_with(const Expression& e, const Expression& t) {
  Graph& graph = e.graph();
  Polynomial part;
  for (const auto& [term, coefficient] : multiplied_out(e)) {
    if (depends_on(to_expression(graph, term), t)) add(part, term, coefficient);
  }
  return to_expression(graph, part);
}

/// Without terms of t alone, which no equation of motion has.
Expression with_motion(const Expression& e, std::span<const Expression> q, std::span<const Expression> rates,
                       const Expression& t) {
  Graph& graph = e.graph();
  Polynomial kept;
  for (const auto& [monomial, coefficient] : multiplied_out(e)) {
    const Expression term = to_expression(graph, monomial);
    const auto is_in = [&](const Expression& symbol) { return depends_on(term, symbol); };
    if (!is_in(t) || std::ranges::any_of(q, is_in) || std::ranges::any_of(rates, is_in))
      add(kept, monomial, coefficient);
  }
  return to_expression(graph, kept);
}

}  // namespace

std::optional<Expression> without_explicit_time(const Expression& lagrangian, std::span<const Expression> q,
                                                std::span<const Expression> rates, const Expression& t) {
  if (!depends_on(lagrangian, t)) return std::nullopt;
  Graph& graph = lagrangian.graph();
  std::vector<Replacement> at_rest, along{{t, graph.number(1)}};
  for (std::size_t i = 0; i < q.size(); ++i) {
    at_rest.emplace_back(rates[i], graph.number(0));
    along.emplace_back(q[i], rates[i]);
  }
  Expression gauge = graph.number(0);
  for (std::size_t i = 0; i < q.size(); ++i) {
    const Expression slope = substitute(differentiate(lagrangian, rates[i]), at_rest);
    const Expression missing = simplify(part_with(slope, t) - differentiate(gauge, q[i]));
    const auto more = integral_of(missing, q[i]);
    if (!more) return std::nullopt;
    gauge = gauge + *more;
  }
  const Expression left = with_motion(lagrangian - total_derivative(gauge, along), q, rates, t);
  return depends_on(left, t) ? std::nullopt : std::optional(left);
}

}  // namespace qdot
