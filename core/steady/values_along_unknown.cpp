#include "core/steady/values_along_unknown.hpp"

#include <algorithm>

#include "core/compile/tape_evaluator.hpp"
#include "core/expr/calculus.hpp"
#include "core/expr/simplify.hpp"

namespace qdot {
namespace {

/// The argument of a logarithm, or of a power that is not whole.
[[nodiscard]] std::optional<Expression> what_has_to_be_positive(Graph& graph, NodeId id) {
  if (const auto* call = std::get_if<Call>(&graph.node(id)))
    return call->function == Function::log ? std::optional(Expression(graph, call->argument)) : std::nullopt;
  const auto* power = std::get_if<Power>(&graph.node(id));
  if (power == nullptr || power->exponent.is_integer()) return std::nullopt;
  return Expression(graph, power->base);
}

/// What is given beside the unknown, as typed.
[[nodiscard]] std::vector<RealAssignment> given_numbers(const BalanceProblem& problem, Graph& graph) {
  std::vector<RealAssignment> numbers;
  for (std::size_t i = 0; i < problem.parameters.size(); ++i)
    numbers.emplace_back(graph.symbol(problem.scene().parameters[i].name), problem.parameters.exact(i));
  const std::size_t n = problem.scene().coordinates.size();
  for (std::size_t i = 0; i < n; ++i) {
    const std::string& name = problem.scene().coordinates[i].name;
    numbers.emplace_back(graph.symbol(name), problem.y.exact(i));
    numbers.emplace_back(graph.symbol(name + "_dot"), problem.y.exact(n + i));
  }
  return numbers;
}

/// The zeros of what force k divides by, where they are told by algebra: 0, and -a/b of a + b u.
[[nodiscard]] std::vector<Expression> poles_by_algebra(const BalanceProblem& problem, Graph& graph) {
  const Expression u = graph.symbol(problem.unknown), zero = graph.number(0);
  const Replacement origin{u, zero};
  std::vector<Expression> found;
  for (const Expression& pole : problem.polynomial->pole_forms) {
    const Expression divisor = graph.adopt(pole), slope = simplify(differentiate(divisor, u));
    const Expression offset = simplify(substitute(divisor, {&origin, 1}));
    if (offset.is_zero())
      found.push_back(zero);
    else if (!slope.is_zero() && !depends_on(slope, u))
      found.push_back(-offset / slope);
  }
  return found;
}

/// The numerator of force k vanishes identically at a pole that is inside of u.
[[nodiscard]] bool is_zero_at_pole(const BalanceProblem& problem, const Interval& u, std::size_t k) {
  Graph graph(*problem.polynomial->graph);
  const Expression e = graph.adopt(problem.polynomial->whole[k]);
  const std::vector<RealAssignment> numbers = given_numbers(problem, graph);
  return std::ranges::any_of(poles_by_algebra(problem, graph), [&](const Expression& pole) {
    const Replacement there{graph.symbol(problem.unknown), pole};
    const Interval place = Interval::literal(evaluate_exactly(pole, numbers));
    return place.lower >= u.lower && place.upper <= u.upper && simplify(substitute(e, {&there, 1})).is_zero();
  });
}

[[nodiscard]] bool may_be_pole(const BalanceProblem& problem, const Interval& u) {
  const CompiledFunction& function = problem.polynomial->poles;
  std::vector<Interval> divisors(function.outputs()), place = problem.x;
  place.push_back(u);
  TapeEvaluator<Interval>(function, problem.constants)(place, divisors);
  return std::ranges::any_of(divisors, [](const Interval& divisor) { return divisor.contains(0.0); });
}

}  // namespace

std::vector<HalfLine> half_lines(const BalanceProblem& problem, Graph& graph, std::size_t k) {
  const Expression e = graph.adopt(problem.polynomial->whole[k]), u = graph.symbol(problem.unknown);
  const std::vector<RealAssignment> numbers = given_numbers(problem, graph);
  std::vector<HalfLine> found;
  const NodeId root = e.id();
  for (const NodeId id : reachable(graph, {&root, 1})) {
    const auto argument = what_has_to_be_positive(graph, id);
    if (!argument || !depends_on(*argument, u)) continue;
    const Expression slope = simplify(differentiate(*argument, u));
    if (depends_on(slope, u)) continue;
    const Replacement origin{u, graph.number(0)};
    const Expression end = -substitute(*argument, {&origin, 1}) / slope;
    const Interval rise = Interval::literal(evaluate_exactly(slope, numbers)),
                   place = Interval::literal(evaluate_exactly(end, numbers));
    if (rise.contains(0.0) || !rise.is_finite() || !place.is_finite()) continue;
    found.push_back({*argument, slope, end, place, rise.lower > 0 ? 1 : -1});
  }
  return found;
}

bool has_other_ends(const BalanceProblem& problem, std::size_t k) {
  Graph graph(*problem.polynomial->graph);
  const Expression e = graph.adopt(problem.polynomial->whole[k]), u = graph.symbol(problem.unknown);
  const NodeId root = e.id();
  return std::ranges::any_of(reachable(graph, {&root, 1}), [&](NodeId id) {
    const auto* call = std::get_if<Call>(&graph.node(id));
    if (call != nullptr && (call->function == Function::asin || call->function == Function::acos))
      return depends_on({graph, call->argument}, u);
    const auto argument = what_has_to_be_positive(graph, id);
    return argument && depends_on(*argument, u) && depends_on(simplify(differentiate(*argument, u)), u);
  });
}

Candidates without_poles(const BalanceProblem& problem, Candidates found, std::size_t k) {
  const auto told =
      std::stable_partition(found.values.begin(), found.values.end(),
                            [&](const BalancingValue& value) { return !may_be_pole(problem, value.u); });
  const bool are_poles = std::all_of(told, found.values.end(), [&](const BalancingValue& value) {
    return value.is_one && is_zero_at_pole(problem, value.u, k);
  });
  if (!are_poles) return {Obstacle::not_decided, {}, "", 0};
  if (told == found.values.begin() && told != found.values.end())
    return {Obstacle::at_pole, {}, "", told->u.middle()};
  found.values.erase(told, found.values.end());
  return found;
}

}  // namespace qdot
