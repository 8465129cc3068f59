#include "core/expr/linear_factors.hpp"

#include <algorithm>

#include "core/expr/polynomial_gcd.hpp"
#include "core/expr/rational_roots.hpp"

namespace qdot {
namespace {

constexpr int highest_degree = 12;
constexpr std::size_t longest_searched = 200;

/// Coefficients of the powers of x, from the lowest on.
using ByPowers = std::vector<Polynomial>;

ByPowers by_powers_of(const Polynomial& a, NodeId x) {
  ByPowers parts;
  for (const auto& [monomial, coefficient] : a) {
    const auto power = static_cast<std::size_t>(exponent_of(monomial, x));
    if (parts.size() <= power) parts.resize(power + 1);
    add(parts[power], times(monomial, x, -static_cast<int>(power)), coefficient);
  }
  return parts;
}

int total_degree(const Monomial& monomial) {
  int sum = 0;
  for (const Atom& atom : monomial) sum += atom.p;
  return sum;
}

int total_degree(const Polynomial& a) {
  int largest = 0;
  for (const auto& term : a) largest = std::max(largest, total_degree(term.first));
  return largest;
}

Polynomial part_of_degree(const Polynomial& a, int degree) {
  Polynomial part;
  for (const auto& [monomial, coefficient] : a) {
    if (total_degree(monomial) == degree) part.emplace(monomial, coefficient);
  }
  return part;
}

Number constant_term(const Polynomial& a) {
  const auto found = a.find({});
  return found == a.end() ? Number(0) : found->second;
}

/// Of y = leading x: powers with coefficients of which the last is 1.
ByPowers monic(const ByPowers& parts) {
  ByPowers result(parts.size(), Polynomial{{Monomial{}, Number(1)}});
  Polynomial front = result.back();
  for (std::size_t k = parts.size() - 1; k-- > 0;) {
    result[k] = parts[k] * front;
    if (k > 0) front = front * parts.back();
  }
  return result;
}

/// Numbers that are in no relation to each other, for the symbols.
Number place_of(NodeId symbol) {
  constexpr std::int64_t step = 37, most = 101;
  return Number(2 + static_cast<std::int64_t>(symbol) * step % most);
}

Number value_there(const Polynomial& a) {
  Number sum(0);
  for (const auto& [monomial, coefficient] : a) {
    Number product = coefficient;
    for (const Atom& atom : monomial) product = product * power(place_of(atom.base), atom.p);
    sum = sum + product;
  }
  return sum;
}

/// a with s + direction * (its place) for each symbol s.
Polynomial moved(const Polynomial& a, int direction) {
  Polynomial sum;
  for (const auto& [monomial, coefficient] : a) {
    Polynomial product{{Monomial{}, coefficient}};
    for (const Atom& atom : monomial) {
      Polynomial symbol{{Monomial{{atom.base, 1, 1}}, Number(1)}};
      add(symbol, Monomial{}, Number(direction) * place_of(atom.base));
      for (int i = 0; i < atom.p; ++i) product = product * symbol;
    }
    add(sum, product);
  }
  return sum;
}

Polynomial value_at(const ByPowers& parts, const Polynomial& y) {
  Polynomial sum = parts.back();
  for (std::size_t k = parts.size() - 1; k-- > 0;) {
    sum = sum * y;
    add(sum, parts[k]);
  }
  return sum;
}

/// Of roots of a monic polynomial: y^n has no higher degree than all other terms.
int highest_degree_of_roots(const ByPowers& parts) {
  int result = 0;
  const auto n = static_cast<int>(parts.size()) - 1;
  for (int k = 0; k < n; ++k) {
    const Polynomial& part = parts[static_cast<std::size_t>(k)];
    if (!part.empty()) result = std::max(result, total_degree(part) / (n - k));
  }
  return result;
}

/// The polynomial y with f(y) = 0 identically that is y0 at the origin, a simple root there.
std::optional<Polynomial> root_from(const ByPowers& f, const Number& y0, int most_degree) {
  Number slope(0), power(1);
  for (std::size_t k = 1; k < f.size(); ++k) {
    slope = slope + Number(static_cast<std::int64_t>(k)) * constant_term(f[k]) * power;
    power = power * y0;
  }
  if (slope.is_zero()) return std::nullopt;
  Polynomial y;
  if (!y0.is_zero()) add(y, Monomial{}, y0);
  for (int degree = 0;; ++degree) {
    const Polynomial rest = value_at(f, y);
    if (rest.empty()) return y;
    if (degree == most_degree) return std::nullopt;
    add(y, part_of_degree(rest, degree + 1), Number(-1) / slope);
  }
}

bool can_be_searched(const Polynomial& a) {
  return a.size() <= longest_searched && std::ranges::all_of(a, [](const auto& term) {
           return std::ranges::all_of(term.first, [](const Atom& atom) { return atom.p > 0 && atom.q == 1; });
         });
}

std::optional<Polynomial> linear_factor(const Polynomial& a, NodeId x) {
  const ByPowers parts = by_powers_of(a, x);
  const auto degree = static_cast<int>(parts.size()) - 1;
  if (degree < 2 || degree > highest_degree) return std::nullopt;
  const ByPowers in_y = monic(parts);
  std::vector<Number> line;
  for (const Polynomial& part : in_y) line.push_back(value_there(part));
  const std::vector<Number> roots = rational_roots(line);
  if (roots.empty()) return std::nullopt;
  ByPowers here;
  for (const Polynomial& part : in_y) here.push_back(moved(part, 1));
  for (const Number& y0 : roots) {
    const auto root = root_from(here, y0, highest_degree_of_roots(in_y));
    if (!root) continue;
    Polynomial factor = scaled(parts.back(), Monomial{{x, 1, 1}}, Number(1));
    add(factor, moved(*root, -1), Number(-1));
    factor = *exact_quotient(factor, content_in(factor, x));
    if (exact_quotient(a, factor)) return factor;
  }
  return std::nullopt;
}

std::vector<NodeId> all_symbols(const Polynomial& a) {
  std::vector<NodeId> symbols;
  for (const auto& term : a) {
    for (const Atom& atom : term.first) symbols.push_back(atom.base);
  }
  std::ranges::sort(symbols);
  symbols.erase(std::unique(symbols.begin(), symbols.end()), symbols.end());
  return symbols;
}

}  // namespace

std::optional<Polynomial> linear_factor(const Polynomial& a) {
  if (!can_be_searched(a)) return std::nullopt;
  for (const NodeId x : all_symbols(a)) {
    if (auto found = linear_factor(a, x)) return found;
  }
  return std::nullopt;
}

}  // namespace qdot
