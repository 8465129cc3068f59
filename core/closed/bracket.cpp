#include "core/closed/bracket.hpp"

#include <map>

#include "core/closed/place_algebra.hpp"
#include "core/expr/calculus.hpp"

namespace qdot {
namespace {

/// The sum with a fractional power in e that depends on x.
std::optional<NodeId> fractional_base(Graph& graph, const Polynomial& e, const Expression& x) {
  for (const auto& [monomial, coefficient] : e) {
    for (const Atom& atom : monomial) {
      const Expression base(graph, atom.base);
      if (atom.q > 1 && std::holds_alternative<Sum>(base.node()) && depends_on(base, x)) return atom.base;
    }
  }
  return std::nullopt;
}

/// c where b is c times the bracket, and does not depend on x.
std::optional<Expression> multiple(const Expression& b, const BracketPower& bracket) {
  if (b == bracket.base) return b.graph().number(1);
  if (!std::holds_alternative<Sum>(b.node()) || !depends_on(b, bracket.x)) return std::nullopt;
  const RationalFunction c = in_lowest_terms(multiplied_out(b), multiplied_out(bracket.base));
  const Expression factor = to_expression(b.graph(), c);
  return depends_on(factor, bracket.x) ? std::nullopt : std::optional(factor);
}

}  // namespace

std::optional<BracketPower> bracket_in(Graph& graph, const Polynomial& e, const Expression& x,
                                       const SignOf& sign) {
  const auto base = fractional_base(graph, e, x);
  if (!base) return std::nullopt;
  std::map<Number, Polynomial> parts;
  for (const auto& [monomial, coefficient] : e) {
    Number exponent(0);
    Monomial rest;
    for (const Atom& atom : monomial) {
      if (atom.base == *base)
        exponent = Number::ratio(atom.p, atom.q);
      else
        rest.push_back(atom);
    }
    if (depends_on(to_expression(graph, rest), x)) return std::nullopt;
    add(parts[exponent], rest, coefficient);
  }
  std::erase_if(parts, [](const auto& part) { return part.second.empty(); });
  if (parts.size() != 2) return std::nullopt;
  const auto& [lower, first] = *parts.begin();
  const auto& [higher, second] = *parts.rbegin();
  const RationalFunction value = -in_lowest_terms(first, second);
  if (sign(value.above) * sign(value.below) <= 0) return std::nullopt;
  return BracketPower{x, Expression(graph, *base), higher - lower, value};
}

std::optional<Expression> raised(Graph& graph, const BracketPower& bracket, const Number& exponent,
                                 const SignOf& sign) {
  const auto power = (exponent / bracket.power).small();
  if (!power) return std::nullopt;
  const Number whole(power->numerator);
  if (power->denominator == 1) return pow(to_expression(graph, bracket.value), whole);
  const auto root = root_of_product(graph, bracket.value, static_cast<int>(power->denominator), sign);
  return root ? std::optional(pow(*root, whole)) : std::nullopt;
}

Expression with_bracket_taken(const Expression& e, const BracketPower& bracket, const SignOf& sign) {
  Graph& graph = e.graph();
  std::vector<Replacement> taken;
  const NodeId root = e.id();
  for (const NodeId id : reachable(graph, {&root, 1})) {
    const auto* power = std::get_if<Power>(&graph.node(id));
    if (power == nullptr) continue;
    const auto factor = multiple(Expression(graph, power->base), bracket);
    const auto value = factor ? raised(graph, bracket, power->exponent, sign) : std::nullopt;
    if (value) taken.emplace_back(Expression(graph, id), pow(*factor, power->exponent) * *value);
  }
  return taken.empty() ? e : substitute(e, taken);
}

}  // namespace qdot
