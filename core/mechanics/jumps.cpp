#include "core/mechanics/jumps.hpp"

#include <algorithm>
#include <array>
#include <optional>

#include "core/base/error.hpp"
#include "core/expr/polynomial_gcd.hpp"
#include "core/expr/print/print.hpp"
#include "core/expr/rational_function.hpp"
#include "core/expr/simplify.hpp"
#include "core/mechanics/notation.hpp"

namespace qdot {
namespace {

std::vector<Expression> moving(const Symbols& symbols) {
  std::vector<Expression> result;
  for (const auto* group : {&symbols.coordinates, &symbols.inputs}) {
    for (const auto* part : {&group->value, &group->rate})
      result.insert(result.end(), part->begin(), part->end());
  }
  return result;
}

std::vector<Expression> varying(const Symbols& symbols) {
  std::vector<Expression> result = moving(symbols);
  result.push_back(symbols.t);
  return result;
}

bool divides_by(const Expression& e, std::span<const Expression> symbols) {
  return std::ranges::any_of(reachable(e.graph(), std::array{e.id()}), [&](NodeId id) {
    const Node& node = e.graph().node(id);
    const auto* power = std::get_if<Power>(&node);
    const auto* call = std::get_if<Call>(&node);
    if (call != nullptr && call->function == Function::tan)
      return depends_on(Expression(e.graph(), call->argument), symbols);
    return power != nullptr && power->exponent.is_negative() &&
           depends_on(Expression(e.graph(), power->base), symbols);
  });
}

/// Of one thing that varies, or of the time: atan(y/x), a polar angle, goes on smoothly as another branch.
bool may_jump(const Expression& argument, const Symbols& symbols) {
  const std::vector<Expression> all = varying(symbols);
  const auto number =
      std::ranges::count_if(all, [&](const Expression& x) { return depends_on(argument, x); });
  return (number == 1 || depends_on(argument, symbols.t)) && divides_by(argument, all);
}

/// Where e jumps, the inner ones first.
std::vector<Expression> jumps_of(const Expression& e, const Symbols& symbols) {
  Graph& graph = e.graph();
  std::vector<Expression> found;
  for (const NodeId id : reachable(graph, std::array{e.id()})) {
    const auto* call = std::get_if<Call>(&graph.node(id));
    if (call == nullptr || (call->function != Function::sign && call->function != Function::atan)) continue;
    const Expression argument(graph, call->argument);
    const bool jumps = call->function == Function::sign ? depends_on(argument, varying(symbols))
                                                        : may_jump(argument, symbols);
    if (jumps) found.emplace_back(graph, id);
  }
  return found;
}

Expression argument_of(const Expression& call) {
  return {call.graph(), std::get<Call>(call.node()).argument};
}

/// A number that nobody writes, so that the function is no other one of the same argument.
Expression stand_in(const Expression& argument) {
  return argument.graph().call(Function::atan, Number::ratio(7919, 7907) * argument);
}

/// Whether difference is 0 wherever u is: at the place of a symbol that u is linear in, or by division.
bool vanishes_with(const Expression& difference, const Expression& u, std::span<const Expression> symbols) {
  for (const Expression& x : symbols) {
    if (!depends_on(u, x)) continue;
    const Expression slope = simplify(differentiate(u, x));
    if (depends_on(slope, x) || slope.is_zero()) continue;
    const Replacement at{x, simplify(x - u / slope)};
    return simplify(substitute(difference, {&at, 1})).is_zero();
  }
  const RationalFunction of_u = rational_function(u), of_difference = rational_function(difference);
  const Polynomial common = greatest_common_divisor(of_u.above, of_difference.above);
  return in_lowest_terms(of_u.above, common).above.size() == 1 && common.size() > 1;
}

/// Whether the jump is one of L where things move, or of a momentum at an instant.
bool is_impulse(const Lagrangian& lagrangian, const Expression& jump) try {
  const Expression& l = lagrangian.lagrangian;
  const Expression u = argument_of(jump), one = l.graph().number(1);
  const Replacement above{jump, one}, below{jump, -one};
  const Expression difference = simplify(substitute(l, {&above, 1}) - substitute(l, {&below, 1}));
  if (difference.is_zero()) return false;
  const std::vector<Expression> moved = moving(lagrangian.symbols);
  if (!depends_on(u, moved) && !depends_on(difference, lagrangian.symbols.coordinates.rate)) return false;
  return !vanishes_with(difference, u, varying(lagrangian.symbols));
} catch (const Error&) {  // too large to be told
  return true;
}

}  // namespace

SmoothedJumps::SmoothedJumps(const Expression& e, const Symbols& symbols) : smooth_(e) {
  std::vector<Replacement> smoothed;
  for (const Expression& jump : jumps_of(e, symbols)) {
    const Expression smooth = stand_in(substitute(argument_of(jump), smoothed));
    smoothed.emplace_back(jump, smooth);
    back_.emplace_back(smooth, jump);
  }
  if (!smoothed.empty()) smooth_ = substitute(e, smoothed);
}

Expression SmoothedJumps::with_jumps(const Expression& e) const {
  return back_.empty() ? e : substitute(e, back_);
}

std::string impulse_of_jumps(const Scene& scene, const Lagrangian& lagrangian) {
  for (const Expression& jump : jumps_of(lagrangian.lagrangian, lagrangian.symbols)) {
    if (std::get<Call>(jump.node()).function != Function::sign || !is_impulse(lagrangian, jump)) continue;
    const std::string u = print(argument_of(jump), Form::text, notation_of(scene));
    return "The Lagrangian jumps with sign(" + u + ") where " + u +
           " = 0: the force there is an impulse, which no motion is computed with. Write a step of some "
           "width, such as tanh((" +
           u + ")/width), or an impact.";
  }
  return {};
}

}  // namespace qdot
