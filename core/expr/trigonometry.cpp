#include "core/expr/trigonometry.hpp"

#include <algorithm>
#include <array>
#include <cstdlib>
#include <set>

namespace qdot {
namespace {

bool is_trigonometric(const Call& call) {
  return call.function == Function::sin || call.function == Function::cos;
}

/// The nodes of sin(u) and cos(u).
struct Pair {
  NodeId sine;
  NodeId cosine;
};

Pair pair_of(const Expression& u) { return {sin(u).id(), cos(u).id()}; }

/// sin(u) or cos(u) in a monomial.
struct Wave {
  NodeId id;
  Function function;
  Expression argument;
  int exponent;
};

std::vector<Wave> waves(Graph& graph, const Monomial& monomial) {
  std::vector<Wave> found;
  for (const Atom& atom : monomial) {
    const auto* call = std::get_if<Call>(&graph.node(atom.base));
    if (call == nullptr || !is_trigonometric(*call) || atom.q != 1 || atom.p < 1) continue;
    found.push_back({atom.base, call->function, {graph, call->argument}, atom.p});
  }
  return found;
}

/// The function's other half: cos(u) for sin(u).
NodeId partner_of(const Wave& wave) {
  return (wave.function == Function::sin ? cos(wave.argument) : sin(wave.argument)).id();
}

using Term = Polynomial::value_type;

/// Both terms away, coefficient * rest * result in their place. `first` may be the polynomial's own.
void put(Polynomial& polynomial, const Monomial& first, const Monomial& second, const Expression& result,
         const Monomial& rest, const Number& coefficient) {
  const Polynomial replacement = scaled(multiplied_out(result), rest, coefficient);
  polynomial.erase(first);
  polynomial.erase(second);
  add(polynomial, replacement);
}

/// sin^2 u + cos^2 u = 1 with equal cofactors, 1 - sin^2 u = cos^2 u, 1 - cos^2 u = sin^2 u.
bool join_square(Graph& graph, Polynomial& polynomial, const Term& term) {
  const auto& [monomial, coefficient] = term;
  for (const Wave& wave : waves(graph, monomial)) {
    if (wave.exponent < 2) continue;
    const Monomial rest = times(monomial, wave.id, -2);
    const Monomial partner = times(rest, partner_of(wave), 2);
    const auto square = polynomial.find(partner);
    if (square != polynomial.end() && square->second == coefficient) {
      put(polynomial, monomial, partner, graph.number(1), rest, coefficient);
      return true;
    }
    const auto constant = polynomial.find(rest);
    if (constant != polynomial.end() && constant->second == -coefficient) {
      put(polynomial, monomial, rest, graph.number(1), partner, -coefficient);
      return true;
    }
  }
  return false;
}

/// cos u cos v + sin u sin v = cos(u - v), sin u cos v - cos u sin v = sin(u - v), and the like with u + v.
bool join_product(Graph& graph, Polynomial& polynomial, const Term& term) {
  const auto& [monomial, coefficient] = term;
  const std::vector<Wave> all = waves(graph, monomial);
  for (const Wave& u : all) {
    for (const Wave& v : all) {
      const bool usable = v.function == Function::cos && u.argument != v.argument &&
                          (u.function == Function::sin || u.id < v.id);
      if (!usable) continue;
      const Monomial rest = times(times(monomial, u.id, -1), v.id, -1);
      const Monomial partner = times(times(rest, partner_of(u), 1), partner_of(v), 1);
      const auto found = polynomial.find(partner);
      if (found == polynomial.end()) continue;
      const bool equal = found->second == coefficient;
      if (!equal && found->second != -coefficient) continue;
      const bool minus = equal == (u.function == Function::cos);
      const Expression angle = minus ? u.argument - v.argument : u.argument + v.argument;
      put(polynomial, monomial, partner, graph.call(u.function, angle), rest, coefficient);
      return true;
    }
  }
  return false;
}

/// cos^2 u - sin^2 u = cos 2u.
bool join_double_angle(Graph& graph, Polynomial& polynomial, const Term& term) {
  const auto& [monomial, coefficient] = term;
  for (const Wave& wave : waves(graph, monomial)) {
    if (wave.function != Function::cos || wave.exponent < 2) continue;
    const Monomial rest = times(monomial, wave.id, -2);
    const Monomial partner = times(rest, partner_of(wave), 2);
    const auto found = polynomial.find(partner);
    if (found == polynomial.end() || found->second != -coefficient) continue;
    put(polynomial, monomial, partner, cos(Number(2) * wave.argument), rest, coefficient);
    return true;
  }
  return false;
}

bool join_once(Graph& graph, Polynomial& polynomial) {
  for (const auto rule : {join_square, join_product, join_double_angle}) {
    for (const Term& term : polynomial) {
      if (rule(graph, polynomial, term)) return true;
    }
  }
  return false;
}

/// Every `square`^2 becomes 1 - other^2, as long as there is one.
Polynomial without_squares(Graph& graph, const Polynomial& polynomial, NodeId square, NodeId other) {
  Polynomial result;
  for (const auto& [monomial, coefficient] : polynomial) {
    const int exponent = exponent_of(monomial, square);
    if (exponent < 2) {
      add(result, monomial, coefficient);
      continue;
    }
    const Expression one_minus = graph.number(1) - pow(Expression(graph, other), Number(2));
    const Polynomial replaced = multiplied_out(pow(one_minus, Number(exponent / 2)));
    add(result, scaled(replaced, times(monomial, square, -(exponent - exponent % 2)), coefficient));
  }
  return result;
}

/// cos(n u) or sin(n u) for a whole n by cos((n+1)u) = 2 cos u cos(nu) - cos((n-1)u), likewise sin.
Expression of_multiple(Function function, int n, const Expression& u) {
  Expression before = u.graph().number(function == Function::cos ? 1 : 0);
  Expression now = u.graph().call(function, u);
  if (n == 0) return before;
  for (int i = 1; i < n; ++i) {
    const Expression next = expand(Number(2) * cos(u) * now - before);
    before = now;
    now = next;
  }
  return now;
}

constexpr int largest_multiple = 12;

/// function(argument) by the addition theorems, term after term of the argument.
Expression of_single_angles(Function function, const Expression& argument) {
  Graph& graph = argument.graph();
  const Polynomial terms = multiplied_out(argument);
  const auto& [monomial, coefficient] = *terms.begin();
  const auto whole = coefficient.whole(largest_multiple);
  const int n = static_cast<int>(std::abs(whole.value_or(1)));
  const Expression angle = (whole ? Number(1) : coefficient) * to_expression(graph, monomial);
  const Number sign(whole && coefficient.is_negative() ? -1 : 1);
  const Expression cosine = of_multiple(Function::cos, n, angle);
  const Expression sine = sign * of_multiple(Function::sin, n, angle);
  if (terms.size() == 1) return function == Function::cos ? cosine : sine;
  Polynomial others = terms;
  others.erase(others.begin());
  const Expression rest = to_expression(graph, others);
  const Expression rest_cosine = of_single_angles(Function::cos, rest);
  const Expression rest_sine = of_single_angles(Function::sin, rest);
  return function == Function::cos ? cosine * rest_cosine - sine * rest_sine
                                   : sine * rest_cosine + cosine * rest_sine;
}

Polynomial with_single_angles(Graph& graph, const Atom& atom) {
  const auto* call = std::get_if<Call>(&graph.node(atom.base));
  const bool opens = call != nullptr && is_trigonometric(*call) && atom.q == 1 && atom.p > 0;
  return multiplied_out(opens ? pow(of_single_angles(call->function, {graph, call->argument}), Number(atom.p))
                              : pow(Expression(graph, atom.base), Number::ratio(atom.p, atom.q)));
}

}  // namespace

std::vector<Expression> trigonometric_arguments(Graph& graph, const Polynomial& polynomial) {
  std::set<NodeId> found;
  for (const auto& [monomial, coefficient] : polynomial) {
    for (const Atom& atom : monomial) {
      const auto* call = std::get_if<Call>(&graph.node(atom.base));
      if (call != nullptr && is_trigonometric(*call)) found.insert(call->argument);
    }
  }
  std::vector<Expression> arguments;
  for (const NodeId id : found) arguments.emplace_back(graph, id);
  return arguments;
}

Polynomial joined(Graph& graph, Polynomial polynomial) {
  while (join_once(graph, polynomial)) {
  }
  return polynomial;
}

Polynomial without_sine_squares(Graph& graph, const Polynomial& polynomial, const Expression& u) {
  const auto [sine, cosine] = pair_of(u);
  return without_squares(graph, polynomial, sine, cosine);
}

Polynomial without_cosine_squares(Graph& graph, const Polynomial& polynomial, const Expression& u) {
  const auto [sine, cosine] = pair_of(u);
  return without_squares(graph, polynomial, cosine, sine);
}

Polynomial with_double_angle(Graph& graph, const Polynomial& polynomial, const Expression& u) {
  const auto [sine, cosine] = pair_of(u);
  const Number half = Number::ratio(1, 2);
  const Expression cosine_of_double = cos(Number(2) * u);
  const Expression one = graph.number(1);
  Polynomial result;
  for (const auto& [monomial, coefficient] : polynomial) {
    Expression replaced = one;
    Monomial rest = monomial;
    while (exponent_of(rest, sine) >= 1 && exponent_of(rest, cosine) >= 1) {
      rest = times(times(rest, sine, -1), cosine, -1);
      replaced = replaced * (half * sin(Number(2) * u));
    }
    for (; exponent_of(rest, sine) >= 2; rest = times(rest, sine, -2)) {
      replaced = replaced * (half * (one - cosine_of_double));
    }
    for (; exponent_of(rest, cosine) >= 2; rest = times(rest, cosine, -2)) {
      replaced = replaced * (half * (one + cosine_of_double));
    }
    add(result, scaled(multiplied_out(replaced), rest, coefficient));
  }
  return result;
}

std::optional<Polynomial> trigonometric_quotient(Graph& graph, const Polynomial& a, const Polynomial& b) {
  if (const auto exact = exact_quotient(a, b)) return exact;
  for (const Expression& u : trigonometric_arguments(graph, a)) {
    for (const auto rewritten : {without_sine_squares, without_cosine_squares}) {
      if (const auto exact = exact_quotient(rewritten(graph, a, u), rewritten(graph, b, u))) return exact;
    }
  }
  const Polynomial single = with_single_angles(graph, a);
  return single == a ? std::nullopt : trigonometric_quotient(graph, single, b);
}

Polynomial with_single_angles(Graph& graph, const Polynomial& polynomial) {
  std::vector<std::pair<Atom, Polynomial>> opened;
  const auto single = [&](const Atom& atom) -> const Polynomial& {
    const auto known = std::ranges::find(opened, atom, &std::pair<Atom, Polynomial>::first);
    if (known != opened.end()) return known->second;
    return opened.emplace_back(atom, with_single_angles(graph, atom)).second;
  };
  Polynomial result;
  for (const auto& [monomial, coefficient] : polynomial) {
    Polynomial product{{Monomial{}, coefficient}};
    for (const Atom& atom : monomial) product = product * single(atom);
    add(result, product);
  }
  for (const Expression& u : trigonometric_arguments(graph, result)) {
    result = without_sine_squares(graph, result, u);
  }
  return result;
}

}  // namespace qdot
