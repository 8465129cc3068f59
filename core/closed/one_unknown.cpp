#include "core/closed/one_unknown.hpp"

#include <algorithm>
#include <map>
#include <numeric>

#include "core/closed/place_algebra.hpp"

namespace qdot {
namespace {

/// The exponent of a base, and the monomial without it.
std::pair<Fraction, Monomial> taken_apart(const Monomial& monomial, NodeId base) {
  Fraction exponent;
  Monomial rest;
  for (const Atom& atom : monomial) {
    if (atom.base == base)
      exponent = {atom.p, atom.q};
    else
      rest.push_back(atom);
  }
  return {exponent, rest};
}

/// The largest step of which all are multiples; positive.
Number common_step(const std::map<Number, Polynomial>& parts, const Number& lowest) {
  std::int64_t above = 0, below = 1;
  for (const auto& [exponent, part] : parts) {
    const auto apart = (exponent - lowest).small();
    if (!apart || apart->numerator == 0) continue;
    const std::int64_t common = std::lcm(below, apart->denominator);
    above = std::gcd(above * (common / below), apart->numerator * (common / apart->denominator));
    below = common;
  }
  return Number::ratio(above, below);
}

/// A sum that depends on x, of which e has odd powers of the square root.
std::optional<NodeId> under_a_root(Graph& graph, const Polynomial& e, const Expression& x) {
  for (const auto& [monomial, coefficient] : e) {
    for (const Atom& atom : monomial) {
      const Expression base(graph, atom.base);
      if (atom.q == 2 && std::holds_alternative<Sum>(base.node()) && depends_on(base, x)) return atom.base;
    }
  }
  return std::nullopt;
}

/// Whether x stands in nothing else but in whole powers.
bool stands_alone(Graph& graph, const Polynomial& e, const Expression& x, NodeId base) {
  return std::ranges::all_of(e, [&](const auto& term) {
    return std::ranges::all_of(term.first, [&](const Atom& atom) {
      const Expression other(graph, atom.base);
      return atom.base == base || (other == x && atom.q == 1) || !depends_on(other, x);
    });
  });
}

}  // namespace

std::optional<QuadraticInPower> quadratic_in_power(Graph& graph, const Polynomial& e, const Expression& x) {
  std::map<Number, Polynomial> parts;
  for (const auto& [monomial, coefficient] : e) {
    const auto [exponent, rest] = taken_apart(monomial, x.id());
    if (depends_on(to_expression(graph, rest), x)) return std::nullopt;
    add(parts[Number::ratio(exponent.numerator, exponent.denominator)], rest, coefficient);
  }
  std::erase_if(parts, [](const auto& part) { return part.second.empty(); });
  if (parts.size() < 2 || parts.size() > 3) return std::nullopt;
  const Number lowest = parts.begin()->first, step = common_step(parts, lowest);
  QuadraticInPower result{step, std::vector<Expression>(3, graph.number(0))};
  for (const auto& [exponent, part] : parts) {
    const auto k = ((exponent - lowest) / step).whole(2);
    if (!k) return std::nullopt;
    result.c[static_cast<std::size_t>(*k)] = to_expression(graph, part);
  }
  return result;
}

Expression root_of_power(const Expression& value, const Number& n, const SignOf& sign) {
  Graph& graph = value.graph();
  const auto small = n.small();
  if (!small) return pow(value, Number(1) / n);
  const RationalFunction power = rational_function(pow(value, Number(small->denominator)));
  if (small->numerator == 1) return to_expression(graph, power);
  if (small->numerator == 2) return positive_root(graph, power, sign);
  const auto root = root_of_product(graph, power, static_cast<int>(small->numerator), sign);
  return root ? *root : pow(value, Number::ratio(small->denominator, small->numerator));
}

std::optional<Polynomial> without_square_root(Graph& graph, const Polynomial& e, const Expression& x) {
  constexpr int most = 6;
  const auto base = under_a_root(graph, e, x);
  if (!base || !stands_alone(graph, e, x, *base)) return std::nullopt;
  const auto halves = [&](const Monomial& monomial) {
    const Fraction exponent = taken_apart(monomial, *base).first;
    return exponent.denominator > 2 ? most + 1
                                    : static_cast<int>(2 * exponent.numerator / exponent.denominator);
  };
  int lowest = 0, highest = 0;
  for (const auto& [monomial, coefficient] : e) {
    lowest = std::min(lowest, halves(monomial));
    highest = std::max(highest, halves(monomial));
  }
  if (highest - lowest > most) return std::nullopt;
  if (lowest % 2 != 0) --lowest;
  const Polynomial b = multiplied_out(Expression(graph, *base));
  Polynomial whole, beside_root;
  for (const auto& [monomial, coefficient] : e) {
    const int n = halves(monomial) - lowest;
    Polynomial term{{taken_apart(monomial, *base).second, coefficient}};
    for (int k = 0; k < n / 2; ++k) term = term * b;
    add(n % 2 == 0 ? whole : beside_root, term);
  }
  if (whole.empty() || beside_root.empty()) return std::nullopt;
  Polynomial result = whole * whole;
  add(result, beside_root * beside_root * b, Number(-1));
  return result;
}

}  // namespace qdot
