#include "core/closed/gamma_period.hpp"

#include <array>

#include "core/closed/place_algebra.hpp"
#include "core/expr/calculus.hpp"
#include "core/expr/rational_function.hpp"
#include "core/numerics/function.hpp"

namespace qdot {
namespace {

/// log Gamma(z) by Stirling's series, z moved up to where that is good to all digits.
double log_gamma(double z) {
  constexpr double good = 12, half_log_two_pi = 0.9189385332046727;
  constexpr std::array coefficients{1.0 / 12,    -1.0 / 360, 1.0 / 1260,
                                    -1.0 / 1680, 1.0 / 1188, -691.0 / 360360};
  double product = 1;
  for (; z < good; ++z) product *= z;
  double sum = 0, power = 1 / z;
  for (const double c : coefficients) {
    sum += c * power;
    power /= z * z;
  }
  const double log_z = evaluate(Function::log, z);
  return (z - 0.5) * log_z - z + half_log_two_pi + sum - evaluate(Function::log, product);
}

}  // namespace

std::optional<GammaPeriod> gamma_period(const QuadratureProblem& problem, const ExactValues& values) {
  Graph& graph = *values.graph();
  const Expression& x = problem.x;
  if (depends_on(problem.inertia, x)) return std::nullopt;
  const auto on_side = [&](int side) {
    const Expression sign = graph.number(Number(side));
    const std::vector<Replacement> there{
        {graph.call(Function::abs, x), x}, {graph.call(Function::sign, x), sign}, {x, sign * x}};
    return substitute(problem.potential, there);
  };
  const RationalFunction u = rational_function(on_side(1));
  const int n = highest_power(u.above, x);
  if (n < 3 || depends_on(to_expression(graph, u.below), x)) return std::nullopt;
  if (!rational_function(on_side(1) - on_side(-1)).is_zero()) return std::nullopt;
  const auto parts = linear_in(graph, u.above, x, x, n);
  if (!parts) return std::nullopt;
  const Expression below = to_expression(graph, u.below);
  const Expression a = to_expression(graph, parts->slope) / below;
  const RationalFunction f = rational_function(problem.energy - to_expression(graph, parts->rest) / below);
  const Expression high = to_expression(graph, f);
  if (values.sign(a) <= 0 || values.sign(high) <= 0) return std::nullopt;
  const Expression root = sqrt(Number(2) * graph.symbol("pi") * problem.inertia / high);
  return GammaPeriod{Number::ratio(2, n) * root * pow(high / a, Number::ratio(1, n)), n};
}

double gamma_quotient(int n) {
  const double z = 1.0 / n;
  return evaluate(Function::exp, log_gamma(z) - log_gamma(z + 0.5));
}

}  // namespace qdot
