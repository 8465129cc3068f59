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

/// factor K(m).
struct PendulumPeriod {
  Expression factor, m;
};

/// The lowest point is at 0 or at pi.
std::optional<PendulumPeriod> pendulum_period(const QuadratureProblem& problem, const ExactValues& values) {
  Graph& graph = *values.graph();
  const auto& [x, inertia, potential, energy] = problem;
  if (depends_on(simplify(inertia), x)) return std::nullopt;
  const Expression u = graph.symbol("w of x");
  const Replacement cosine{cos(x), u};
  const RationalFunction f = rational_function(potential);
  const Expression e = substitute(to_expression(graph, with_single_angles(graph, f.above)), {&cosine, 1});
  if (depends_on(e, x) || depends_on(to_expression(graph, f.below), x)) return std::nullopt;
  const auto c = univariate(graph, multiplied_out(e), u);
  if (!c || c->size() != 2) return std::nullopt;
  const RationalFunction below = RationalFunction{f.below};
  const Expression slope = to_expression(graph, (*c)[1] / below),
                   level = to_expression(graph, (*c)[0] / below);
  const int sign = values.sign(slope);
  if (sign == 0) return std::nullopt;
  const Expression depth = Number(sign) * slope;
  const Expression m = (energy - level + depth) / (Number(2) * depth);
  const Expression root = positive_root(graph, rational_function(inertia / depth), values.sign_of());
  return PendulumPeriod{Number(4) * root, half_angle(simplify(m))};
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
                                                 const Finding& found, const WrittenForm& written) {
  const auto period = pendulum_period(problem, values);
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
                                      const Finding& found, const WrittenForm& written) {
  std::optional<ClosedForm> best;
  for (const Expression& period : elementary_periods(problem, values)) {
    if (!agrees(values.value(period), *found.value, found.error)) continue;
    for (const Relations& relations : {values.relations(), Relations{}}) {
      auto form = written(simplify(substitute(period, relations.replacements)), relations);
      if (form && (!best || form->text.size() < best->text.size())) best = std::move(form);
    }
  }
  return best ? best : with_elliptic_integral(problem, values, found, written);
}

}  // namespace qdot
