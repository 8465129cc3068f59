#include "core/closed/period_form.hpp"

#include <cmath>
#include <limits>

#include "core/closed/root_integral.hpp"
#include "core/expr/print/print.hpp"
#include "core/expr/simplify.hpp"
#include "core/expr/trigonometry.hpp"
#include "core/mechanics/notation.hpp"
#include "core/numerics/constants.hpp"

namespace qdot {
namespace {

constexpr const char* elliptic_integral =
    "ellipk(m) = K(m) is the integral of 1/sqrt(1 - m*sin(u)^2) over u from 0 to pi/2";

/// sqrt(4 x) as 2 sqrt(x).
Expression with_squares_out(const Expression& e) {
  Graph& graph = e.graph();
  std::vector<Replacement> taken;
  const NodeId root = e.id();
  for (const NodeId id : reachable(graph, {&root, 1})) {
    const auto* power = std::get_if<Power>(&graph.node(id));
    if (power == nullptr || power->exponent.denominator() != Number(2)) continue;
    const auto [coefficient, rest] = split_coefficient(Expression(graph, power->base));
    const auto factor = coefficient.is_negative() ? std::nullopt : exact_root(coefficient);
    if (!factor || *factor == Number(1)) continue;
    const Number twice = power->exponent * Number(2);
    taken.emplace_back(Expression(graph, id), pow(graph.number(*factor), twice) * pow(rest, power->exponent));
  }
  return substitute(e, taken);
}

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

/// factor K(m).
struct PendulumPeriod {
  Expression factor, m;
};

std::optional<PendulumPeriod> pendulum_period(const QuadratureProblem& problem, const ExactValues& values,
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
    return PendulumPeriod{Number(2) * root(Number(2) * problem.inertia / height), simplify(twice / height)};
  return PendulumPeriod{Number::ratio(4, well->turns) * root(problem.inertia / well->depth),
                        half_angle(simplify(height / twice))};
}

/// K(m) to round-off, by the arithmetic-geometric mean.
double complete_elliptic_integral(double one_less_m) {
  double a = 1, b = std::sqrt(one_less_m);
  while (std::abs(a - b) > 1e-8 * a) {
    const double mean = (a + b) / 2;
    b = std::sqrt(a * b);
    a = mean;
  }
  return pi / (a + b);
}

std::optional<ClosedForm> with_elliptic_integral(const QuadratureProblem& problem, const ExactValues& values,
                                                 MotionKind motion, const Finding& found,
                                                 const WrittenForm& written) {
  const auto period = pendulum_period(problem, values, motion);
  if (!period) return std::nullopt;
  const auto& [factor, m] = *period;
  const Real one_less_m = values.value(m.graph().number(1) - m);
  const double value = values.value(factor).value * complete_elliptic_integral(one_less_m.value);
  const double rounding = 8 * std::numeric_limits<double>::epsilon() * value;
  auto form = written(factor * m, {});  // for what it assumes
  if (!form || !agrees({value, 0, rounding}, *found.value, found.error)) return std::nullopt;
  const Notation notation = notation_of(values.model().scene);
  form->text = print(factor, Form::text, notation) + "*ellipk(" + print(m, Form::text, notation) + ")";
  form->latex =
      print(factor, Form::latex, notation) + " K\\left(" + print(m, Form::latex, notation) + "\\right)";
  form->assumes.emplace_back(elliptic_integral);
  return form;
}

}  // namespace

std::optional<ClosedForm> period_form(const QuadratureProblem& problem, const ExactValues& values,
                                      MotionKind motion, const Finding& found, const WrittenForm& written) {
  if (motion == MotionKind::rotation) return with_elliptic_integral(problem, values, motion, found, written);
  std::optional<ClosedForm> best;
  for (const Expression& period : elementary_periods(problem, values)) {
    if (!agrees(values.value(period), *found.value, found.error)) continue;
    for (const Relations& relations : {values.relations(), Relations{}}) {
      const Expression plain = with_squares_out(substitute(period, relations.replacements));
      const Expression short_form = with_squares_out(simplify(plain));
      const bool is_shorter = written_length(short_form) < written_length(plain);
      auto form = written(is_shorter ? short_form : plain, relations);
      if (form && (!best || form->text.size() < best->text.size())) best = std::move(form);
    }
  }
  return best ? best : with_elliptic_integral(problem, values, motion, found, written);
}

}  // namespace qdot
