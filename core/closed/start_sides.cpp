#include "core/closed/start_sides.hpp"

#include <cmath>

#include "core/closed/assumed_signs.hpp"
#include "core/closed/turning_signs.hpp"
#include "core/expr/calculus.hpp"

namespace qdot {
namespace {

/// What stands under abs, sign and square roots without x.
std::vector<Expression> kinks_beside(const Expression& e, const Expression& x) {
  Graph& graph = e.graph();
  std::vector<Expression> kinks;
  const NodeId root = e.id();
  for (const NodeId id : reachable(graph, {&root, 1})) {
    const auto* call = std::get_if<Call>(&graph.node(id));
    const auto* power = std::get_if<Power>(&graph.node(id));
    if (call != nullptr && (call->function == Function::abs || call->function == Function::sign))
      kinks.emplace_back(graph, call->argument);
    else if (power != nullptr && (power->exponent.denominator() / Number(2)).is_integer())
      kinks.emplace_back(graph, power->base);
  }
  std::erase_if(kinks, [&](const Expression& kink) { return depends_on(kink, x); });
  return kinks;
}

/// A square was taken out of a root by the sign of what was squared.
void ask_about_kink(const Expression& kink, AssumedSigns& signs) {
  signs.ask(kink);
  const RationalFunction f = rational_function(kink);
  for (const Polynomial* part : {&f.above, &f.below}) {
    if (const auto root = exact_root(*part)) signs.ask(to_expression(kink.graph(), *root));
  }
}

/// Two expressions that are the same.
using Same = std::pair<Expression, Expression>;

bool are_same(const Same& same, double a, double b) {
  const double rounding = 1e-12 * static_cast<double>(written_length(same.first));
  return std::abs(a - b) <= rounding * (std::abs(a) + std::abs(b));
}

std::optional<std::vector<std::string>> sides(const TurningEquation& equation,
                                              const std::vector<Expression>& kinks, const Same& same,
                                              const Relations& relations,
                                              const std::vector<std::string>& assumes) {
  AssumedSigns signs(equation.values, relations, {});
  signs.let_go(not_spoken_of(equation, assumes, {}), [](const FarPlace&) { return std::nullopt; });
  for (const Expression& kink : kinks) ask_about_kink(kink, signs);
  constexpr int tries = 96;
  return signs.separating(
      [&](const FarPlace& far) -> std::optional<Claim> {
        const Real a = evaluate_exactly(same.first, far), b = evaluate_exactly(same.second, far);
        if (!a.is_finite() || !b.is_finite()) return std::nullopt;
        return Claim{.holds = are_same(same, a.value, b.value)};
      },
      tries, 0);
}

}  // namespace

std::optional<std::vector<std::string>> sides_of_constant(const TurningEquation& equation,
                                                          const Expression& e, const Expression& formula,
                                                          const Relations& relations,
                                                          const std::vector<std::string>& assumes) {
  const std::vector<Expression> kinks = kinks_beside(e, equation.x);
  if (kinks.empty()) return std::vector<std::string>{};
  return sides(equation, kinks, {e, formula}, relations, assumes);
}

std::optional<std::vector<std::string>> sides_of_equation(const TurningEquation& equation,
                                                          const Expression& e, const Expression& formula,
                                                          const Relations& relations,
                                                          const std::vector<std::string>& assumes) {
  const std::vector<Expression> kinks = kinks_beside(e, equation.x);
  const std::optional<Expression> start = equation.start();
  if (kinks.empty() || !start) return std::vector<std::string>{};
  // Their quotient is the same at two places.
  Graph& graph = e.graph();
  const auto at = [&](const Expression& any, const Number& part) {
    const Replacement place{equation.x, part * *start + graph.number(part / Number(7))};
    return substitute(any, {&place, 1});
  };
  const Number one = Number::ratio(9, 10), other = Number::ratio(7, 10);
  return sides(equation, kinks, {at(e, one) * at(formula, other), at(e, other) * at(formula, one)}, relations,
               assumes);
}

}  // namespace qdot
