#include "core/closed/elliptic_period.hpp"

#include "core/closed/root_integral.hpp"
#include "core/expr/simplify.hpp"
#include "core/expr/surd.hpp"
#include "core/expr/trigonometry.hpp"

namespace qdot {
namespace {

/// (1 - cos(2 u))/2 as sin(u)^2.
Expression half_angle(const Expression& m) {
  Graph& graph = m.graph();
  const Polynomial terms = multiplied_out(m);
  const Number half = Number::ratio(1, 2);
  const auto constant = terms.find({});
  if (terms.size() != 2 || constant == terms.end() || constant->second != half) return m;
  for (const auto& [monomial, coefficient] : terms) {
    if (monomial.size() != 1 || monomial[0].p != 1 || monomial[0].q != 1) continue;
    const auto* call = std::get_if<Call>(&graph.node(monomial[0].base));
    if (call == nullptr || call->function != Function::cos) continue;
    const Expression u = half * Expression(graph, call->argument);
    if (coefficient == -half) return pow(sin(u), Number(2));
    if (coefficient == half) return pow(cos(u), Number(2));
  }
  return m;
}

/// U = level - depth cos(turns x - x0), depth > 0.
struct CosineWell {
  Expression level, depth;
  int turns;
};

/// Of a potential in cos(x) alone, or in its square.
std::optional<CosineWell> well_of(const Univariate& c, const ExactValues& values) {
  Graph& graph = *values.graph();
  const auto part = [&](std::size_t k) { return to_expression(graph, c[k]); };
  const bool is_square = c.size() == 3;
  if (c.size() < 2 || c.size() > 3 || (is_square && !c[1].is_zero())) return std::nullopt;
  const Expression slope = is_square ? Number::ratio(1, 2) * part(2) : part(1);
  const int sign = values.sign(slope);
  if (sign == 0) return std::nullopt;
  return CosineWell{is_square ? part(0) + slope : part(0), Number(sign) * slope, is_square ? 2 : 1};
}

/// level + along cos(x) + across sin(x).
CosineWell tilted_well(const Univariate& c, const Expression& across, const ExactValues& values) {
  Graph& graph = *values.graph();
  const auto part = [&](std::size_t k) {
    return c.size() > k ? to_expression(graph, c[k]) : graph.number(0);
  };
  const Expression along = part(1);
  const RationalFunction square = rational_function(simplify(along * along + across * across));
  return {part(0), positive_root(graph, square, values.sign_of()), 1};
}

std::optional<CosineWell> cosine_well(const QuadratureProblem& problem, const ExactValues& values) {
  Graph& graph = *values.graph();
  const Expression& x = problem.x;
  const Expression c = graph.symbol("cosine of x"), s = graph.symbol("sine of x");
  const std::vector<Replacement> symbols{{cos(x), c}, {sin(x), s}}, no_sine{{s, graph.number(0)}};
  const RationalFunction f = rational_function(problem.potential);
  const Expression e = substitute(to_expression(graph, with_single_angles(graph, f.above)), symbols);
  const Expression below = to_expression(graph, f.below), across = differentiate(e, s) / below;
  if (depends_on(e, x) || depends_on(below, x) || depends_on(across, c) || depends_on(across, s))
    return std::nullopt;
  const Polynomial rest = multiplied_out(substitute(e, no_sine));
  auto by_cosine = rest.empty() ? std::optional(Univariate{}) : univariate(graph, rest, c);
  if (!by_cosine) return std::nullopt;
  for (RationalFunction& k : *by_cosine) k = k / RationalFunction{f.below};
  if (across.is_zero()) return well_of(*by_cosine, values);
  return by_cosine->size() > 2 ? std::nullopt : std::optional(tilted_well(*by_cosine, across, values));
}

std::optional<EllipticPeriod> pendulum_period(const QuadratureProblem& problem, const ExactValues& values,
                                              MotionKind motion) {
  Graph& graph = *values.graph();
  if (depends_on(simplify(problem.inertia), problem.x)) return std::nullopt;
  const auto well = cosine_well(problem, values);
  if (!well) return std::nullopt;
  const auto root = [&](const Expression& square) {
    return positive_root(graph, rational_function(square), values.sign_of());
  };
  const Expression height = problem.energy - well->level + well->depth, twice = Number(2) * well->depth;
  if (motion == MotionKind::rotation)
    return EllipticPeriod{Number(2) * root(Number(2) * problem.inertia / height), simplify(twice / height)};
  return EllipticPeriod{Number::ratio(4, well->turns) * root(problem.inertia / well->depth),
                        half_angle(simplify(height / twice))};
}

/// a and b of U = level + a x^2/2 + b x^4/4, and s^2 = a^2 + 4 b (h - level).
std::vector<EllipticPeriod> quartic_periods(const QuadratureProblem& problem, const ExactValues& values) {
  Graph& graph = *values.graph();
  const Expression& x = problem.x;
  const RationalFunction f = rational_function(problem.potential);
  if (depends_on(simplify(problem.inertia), x) || depends_on(to_expression(graph, f.below), x)) return {};
  const auto c = univariate(graph, f.above, x);
  if (!c || c->size() != 5 || !(*c)[1].is_zero() || !(*c)[3].is_zero()) return {};
  const auto part = [&](std::size_t k) { return to_expression(graph, (*c)[k] / RationalFunction{f.below}); };
  const Expression a = Number(2) * part(2), b = Number(4) * part(4), one = graph.number(1);
  const auto root = [&](const Expression& square) {
    return positive_root(graph, rational_function(square), values.sign_of());
  };
  const Expression s = root(a * a + Number(4) * b * (problem.energy - part(0)));
  const Number two(2), half = Number::ratio(1, 2);
  return {{Number(4) * root(problem.inertia / s), simplify(half * (one - a / s))},
          {two * root(two * problem.inertia / (s - a)), simplify(two * s / (s - a))},
          {Number(4) * root(two * problem.inertia / (a + s)), simplify((a - s) / (a + s))}};
}

}  // namespace

std::vector<EllipticPeriod> elliptic_periods(const QuadratureProblem& problem, const ExactValues& values,
                                             MotionKind motion) {
  if (const auto pendulum = pendulum_period(problem, values, motion)) return {*pendulum};
  return motion == MotionKind::libration ? quartic_periods(problem, values) : std::vector<EllipticPeriod>{};
}

}  // namespace qdot
