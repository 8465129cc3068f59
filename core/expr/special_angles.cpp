#include "core/expr/special_angles.hpp"

#include <optional>

#include "core/expr/calculus.hpp"
#include "core/expr/polynomial.hpp"

namespace qdot {
namespace {

/// r and u of the angle r pi + u, r in [0, 2).
struct Angle {
  Number turns_of_pi;
  Expression rest;
};

std::optional<Angle> taken_apart(const Expression& argument) {
  Graph& graph = argument.graph();
  Polynomial terms = multiplied_out(argument);
  const auto found = terms.find(Monomial{{graph.symbol("pi").id(), 1, 1}});
  if (found == terms.end()) return std::nullopt;
  Number r = found->second;
  if (r.bits() > 40) return std::nullopt;
  while (r.is_negative()) r = r + Number(2);
  while (!(r < Number(2))) r = r - Number(2);
  terms.erase(found);
  return Angle{r, to_expression(graph, terms)};
}

/// sin(s pi), 0 <= s < 1/2.
std::optional<Expression> sine_in_first_quarter(Graph& graph, const Number& s) {
  const Number half = Number::ratio(1, 2);
  if (s.is_zero()) return graph.number(0);
  if (s == Number::ratio(1, 6)) return graph.number(half);
  if (s == Number::ratio(1, 4)) return half * sqrt(graph.number(2));
  if (s == Number::ratio(1, 3)) return half * sqrt(graph.number(3));
  return std::nullopt;
}

/// sin(quarters pi/2 + s pi + u)
std::optional<Expression> sine_of(Graph& graph, int quarters, const Number& s, const Expression& rest) {
  const bool is_cosine = quarters % 2 == 1;
  std::optional<Expression> value;
  if (!rest.is_zero()) {
    if (!s.is_zero()) return std::nullopt;
    value = is_cosine ? cos(rest) : sin(rest);
  } else if (is_cosine) {
    value = s.is_zero() ? graph.number(1) : sine_in_first_quarter(graph, Number::ratio(1, 2) - s);
  } else {
    value = sine_in_first_quarter(graph, s);
  }
  if (value && quarters % 4 >= 2) value = -*value;
  return value;
}

std::optional<Expression> folded(Graph& graph, const Call& call) {
  if (call.function != Function::sin && call.function != Function::cos) return std::nullopt;
  const auto angle = taken_apart({graph, call.argument});
  if (!angle) return std::nullopt;
  int quarters = 0;
  Number s = angle->turns_of_pi;
  for (const Number half = Number::ratio(1, 2); !(s < half); ++quarters) s = s - half;
  return sine_of(graph, quarters + (call.function == Function::cos ? 1 : 0), s, angle->rest);
}

}  // namespace

Expression with_special_angles(const Expression& e) {
  Graph& graph = e.graph();
  const NodeId root = e.id();
  std::vector<Replacement> values;
  for (const NodeId id : reachable(graph, {&root, 1})) {
    const Node node = graph.node(id);
    const auto* call = std::get_if<Call>(&node);
    if (call == nullptr) continue;
    if (const auto value = folded(graph, *call)) values.emplace_back(Expression(graph, id), *value);
  }
  return values.empty() ? e : substitute(e, values);
}

}  // namespace qdot
