#include "core/closed/barriers.hpp"

#include "core/base/error.hpp"
#include "core/closed/exact_roots.hpp"
#include "core/expr/rational_function.hpp"

namespace qdot {
namespace {

void add_factors(const Polynomial& a, const Expression& x, std::vector<Expression>& factors) {
  Graph& graph = x.graph();
  const auto take = [&](const Expression& factor) {
    if (depends_on(factor, x)) factors.push_back(factor);
  };
  const Monomial common = common_monomial(a);
  for (const Atom& atom : common) take(Expression(graph, atom.base));
  take(to_expression(graph, scaled(a, inverse(common), Number(1))));
}

/// Zeros of the function about 0.
std::vector<Expression> zeros_of(Function function, Graph& graph) {
  const Expression pi = graph.symbol("pi");
  switch (function) {
    case Function::cos:
      return {Number::ratio(1, 2) * pi, Number::ratio(-1, 2) * pi};
    case Function::sin:
    case Function::tan:
      return {graph.number(0), pi, -pi};
    case Function::log:
      return {graph.number(1)};
    default:
      return {};
  }
}

/// Where the sum is linear in x, or in x^2 alone.
std::vector<Expression> zeros_of_sum(const Expression& sum, const Expression& x) {
  const auto c = quadratic_in(sum, x);
  if (!c) return {};
  const Expression &c0 = (*c)[0], &c1 = (*c)[1], &c2 = (*c)[2];
  if (c2.is_zero()) return {-c0 / c1};
  if (!c1.is_zero()) return {};
  const Expression root = sqrt(-c0 / c2);
  return {root, -root};
}

std::vector<Expression> zeros_of(const Expression& factor, const Expression& x) {
  if (factor == x) return {x.graph().number(0)};
  const auto* call = std::get_if<Call>(&factor.node());
  if (call == nullptr) return zeros_of_sum(factor, x);
  const Expression argument(x.graph(), call->argument), slope = differentiate(argument, x);
  if (slope.is_zero() || depends_on(slope, x)) return {};
  const Replacement at_zero{x, x.graph().number(0)};
  const Expression offset = substitute(argument, {&at_zero, 1});
  std::vector<Expression> zeros;
  for (const Expression& y : zeros_of(call->function, x.graph())) zeros.push_back((y - offset) / slope);
  return zeros;
}

}  // namespace

std::vector<Expression> factors_of_inertia(const Expression& inertia, const Expression& x) {
  std::vector<Expression> factors;
  if (!depends_on(inertia, x)) return factors;
  const RationalFunction f = rational_function(inertia);
  add_factors(f.above, x, factors);
  add_factors(f.below, x, factors);
  return factors;
}

std::vector<Expression> places_of_barriers(const std::vector<Expression>& factors, const Expression& x) {
  std::vector<Expression> places;
  for (const Expression& factor : factors) {
    try {
      const std::vector<Expression> zeros = zeros_of(factor, x);
      places.insert(places.end(), zeros.begin(), zeros.end());
    } catch (const Error&) {  // the algebra grows too large: this one stays unknown
    }
  }
  return places;
}

}  // namespace qdot
