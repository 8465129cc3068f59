#include "core/steady/exponential_form.hpp"

#include <algorithm>
#include <map>
#include <optional>

#include "core/expr/calculus.hpp"
#include "core/expr/rational_function.hpp"
#include "core/expr/simplify.hpp"

namespace qdot {
namespace {

constexpr int highest_power_of_w = 24;

bool is_exponential(Function function) {
  return function == Function::exp || function == Function::sinh || function == Function::cosh ||
         function == Function::tanh;
}

std::vector<Call> exponentials_of(const Expression& e, std::span<const Expression> variables) {
  std::vector<Call> found;
  const NodeId root = e.id();
  for (const NodeId id : reachable(e.graph(), {&root, 1})) {
    const auto* call = std::get_if<Call>(&e.graph().node(id));
    if (call != nullptr && is_exponential(call->function) &&
        depends_on(Expression(e.graph(), call->argument), variables))
      found.push_back(*call);
  }
  return found;
}

/// y: all arguments are whole multiples of it.
std::optional<Expression> common_argument(Graph& graph, const std::vector<Call>& calls) {
  std::optional<Scaled> least;
  for (const Call& call : calls) {
    const Scaled argument = split_coefficient(Expression(graph, call.argument));
    if (least && !(argument.rest == least->rest)) return std::nullopt;
    const auto size = [](const Number& c) { return c.is_negative() ? -c : c; };
    if (!least || size(argument.coefficient) < size(least->coefficient)) least = argument;
  }
  const Number size = least->coefficient.is_negative() ? -least->coefficient : least->coefficient;
  for (const Call& call : calls) {
    if (!(split_coefficient(Expression(graph, call.argument)).coefficient / size).is_integer())
      return std::nullopt;
  }
  return size * least->rest;
}

Expression by_powers(Function function, const Expression& w, const Number& k) {
  const Expression up = pow(w, k), down = pow(w, -k);
  const Number half = Number::ratio(1, 2);
  if (function == Function::exp) return up;
  if (function == Function::sinh) return half * (up - down);
  if (function == Function::cosh) return half * (up + down);
  return (up - down) / (up + down);
}

std::map<int, Polynomial> coefficients(const Polynomial& e, const Expression& w) {
  std::map<int, Polynomial> parts;
  for (const auto& [monomial, coefficient] : e) {
    const int power = exponent_of(monomial, w.id());
    add(parts[power], times(monomial, w.id(), -power), coefficient);
  }
  std::erase_if(parts, [](const auto& part) { return part.second.empty(); });
  return parts;
}

/// c_0 + w (c_1 + w (...)), without the lowest power of w.
Expression nested(Graph& graph, const std::map<int, Polynomial>& parts, const Expression& w) {
  auto part = parts.rbegin();
  Expression result = simplify(to_expression(graph, part->second));
  for (int power = part->first; ++part != parts.rend(); power = part->first)
    result = result * pow(w, Number(power - part->first)) + simplify(to_expression(graph, part->second));
  return result;
}

}  // namespace

std::optional<ByExponential> by_exponential(const Expression& e, std::span<const Expression> variables,
                                            Exponential kind) {
  const std::vector<Call> calls = exponentials_of(e, variables);
  if (calls.empty()) return std::nullopt;
  Graph& graph = e.graph();
  const auto y = common_argument(graph, calls);
  if (!y) return std::nullopt;
  const Number sign(kind == Exponential::rising ? 1 : -1);
  const Expression w = graph.symbol("w of exponentials");
  std::vector<Replacement> powers;
  for (const Call& call : calls) {
    const Expression argument(graph, call.argument);
    const Number k = sign * split_coefficient(argument).coefficient / split_coefficient(*y).coefficient;
    powers.emplace_back(graph.call(call.function, argument), by_powers(call.function, w, k));
  }
  const RationalFunction f = rational_function(substitute(e, powers));
  if (depends_on(to_expression(graph, f.below), variables)) return std::nullopt;
  return ByExponential{f.above, w, sign * *y};
}

Expression nested_in_exponentials(const Expression& e, std::span<const Expression> variables,
                                  Exponential kind) {
  const auto found = by_exponential(e, variables, kind);
  if (!found) return e;
  Graph& graph = e.graph();
  const std::map<int, Polynomial> parts = coefficients(found->e, found->w);
  if (parts.empty() || parts.rbegin()->first - parts.begin()->first > highest_power_of_w) return e;
  const Replacement back{found->w, graph.call(Function::exp, found->argument)};
  return substitute(nested(graph, parts, found->w), {&back, 1});
}

}  // namespace qdot
