#include "core/steady/reflections.hpp"

#include <algorithm>
#include <cmath>

#include "core/expr/calculus.hpp"
#include "core/expr/simplify.hpp"
#include "core/expr/special_angles.hpp"
#include "core/steady/fold_on_curve.hpp"

namespace qdot {
namespace {

/// Where f vanishes, if it is linear in x, the first of the variables. False where it is not.
bool add_zero_of(const Expression& f, std::span<const Expression> variables, std::vector<Expression>& found) {
  const Expression slope = simplify(differentiate(f, variables[0]));
  if (slope.is_zero()) return true;
  if (depends_on(slope, variables[0])) return false;
  if (const auto centre = curve_of_line(f, variables)) found.push_back(*centre);
  return true;
}

/// Where the argument of a sine or cosine, linear in x, is a multiple of a right angle, in half a turn of x.
void add_right_angles(const Expression& e, std::span<const Expression> variables,
                      std::vector<Expression>& found) {
  constexpr double most = 12;
  const Expression& x = variables[0];
  Graph& graph = x.graph();
  const NodeId root = e.id();
  for (const NodeId id : reachable(graph, {&root, 1})) {
    const auto* call = std::get_if<Call>(&graph.node(id));
    if (call == nullptr || (call->function != Function::sin && call->function != Function::cos)) continue;
    const Expression argument(graph, call->argument), slope = differentiate(argument, x);
    const std::vector<Replacement> origin{{x, graph.number(0)}};
    const Expression offset = substitute(argument, origin);
    if (slope.number() == nullptr || !has_value_everywhere(offset, variables)) continue;
    const double in_half_a_turn = 2 * std::abs(slope.number()->value());
    for (int k = 0; k < std::min(most, in_half_a_turn); ++k)
      found.push_back((Number::ratio(k, 2) * graph.symbol("pi") - offset) / slope);
  }
}

/// The middle of the roots of a polynomial in x.
void add_middle(const Expression& polynomial, std::span<const Expression> variables,
                std::vector<Expression>& found) {
  constexpr int highest_degree = 8;
  Expression derivative = polynomial;
  for (int k = 0; k < highest_degree && !add_zero_of(derivative, variables, found); ++k)
    derivative = simplify(differentiate(derivative, variables[0]));
}

/// What is left where x stands outside functions, as beside the sine of a pendulum on a torsion spring.
Expression outside_functions(const Expression& e, const Expression& x) {
  Graph& graph = x.graph();
  const NodeId root = e.id();
  std::vector<Replacement> calls;
  for (const NodeId id : reachable(graph, {&root, 1})) {
    const Expression call(graph, id);
    if (std::holds_alternative<Call>(graph.node(id)) && depends_on(call, x))
      calls.emplace_back(call, graph.number(0));
  }
  return calls.empty() ? graph.number(0) : substitute(e, calls);
}

/// 0, where a factor that is linear in x vanishes, and the middle of the roots of a polynomial in x.
std::vector<Expression> candidates(const Expression& numerator, std::span<const Expression> factors,
                                   std::span<const Expression> variables) {
  std::vector<Expression> found{numerator.graph().number(0)};
  for (const Expression& f : factors) add_zero_of(f, variables, found);
  add_middle(numerator, variables, found);
  add_middle(outside_functions(numerator, variables[0]), variables, found);
  add_right_angles(numerator, variables, found);
  return found;
}

/// On a whole axis, as (x - p)^3 does: nothing happens there at any p.
bool rests_without_stiffness(const Expression& numerator, const Expression& x, const Expression& axis) {
  const Replacement on_axis{x, axis};
  return simplify(with_special_angles(substitute(differentiate(numerator, x), {&on_axis, 1}))).is_zero();
}

}  // namespace

std::vector<Expression> centres_of_reflection(const Expression& numerator,
                                              std::span<const Expression> factors,
                                              std::span<const Expression> variables) {
  const Expression& x = variables[0];
  std::vector<Expression> centres;
  for (const Expression& centre : candidates(numerator, factors, variables)) {
    const std::vector<Replacement> before{{x, centre - x}}, beyond{{x, centre + x}};
    const Expression sum = substitute(numerator, before) + substitute(numerator, beyond);
    const bool odd = simplify(with_special_angles(sum)).is_zero();
    if (depends_on(centre, variables) && rests_without_stiffness(numerator, x, centre)) continue;
    if (odd && std::ranges::find(centres, centre) == centres.end()) centres.push_back(centre);
  }
  return centres;
}

std::vector<Mirror> mirrors_of(std::span<const Expression> numerators, std::span<const Expression> x) {
  constexpr std::size_t most = 3;
  std::vector<Mirror> mirrors;
  for (std::size_t set = 1; x.size() <= most && set < (std::size_t{1} << x.size()); ++set) {
    std::vector<Replacement> reflection;
    Mirror mirror;
    for (std::size_t j = 0; j < x.size(); ++j) {
      if ((set >> j & 1U) == 0) continue;
      reflection.emplace_back(x[j], -x[j]);
      mirror.turned.push_back(j);
    }
    bool same = true;
    for (std::size_t i = 0; same && i < numerators.size(); ++i) {
      const Expression image = substitute(numerators[i], reflection);
      const bool even = simplify(image - numerators[i]).is_zero();
      if (even) mirror.even.push_back(i);
      same = even || simplify(image + numerators[i]).is_zero();
    }
    if (same) mirrors.push_back(std::move(mirror));
  }
  return mirrors;
}

}  // namespace qdot
