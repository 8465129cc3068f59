#include "core/expr/polynomial_gcd.hpp"

#include <algorithm>

#include "core/base/error.hpp"

namespace qdot {
namespace {

constexpr std::size_t most_terms_of_remainders = 300;
constexpr std::int64_t largest_prime_tried = 1000;

const Polynomial one{{Monomial{}, Number(1)}};

bool is_one(const Polynomial& a) { return a.size() == 1 && a.begin()->first.empty(); }

bool has_whole_exponents(const Polynomial& a) {
  return std::ranges::all_of(a, [](const auto& term) {
    return std::ranges::all_of(term.first, [](const Atom& atom) { return atom.p > 0 && atom.q == 1; });
  });
}

/// a with whole coefficients that have no common divisor, the leading one positive.
Polynomial without_content(const Polynomial& a) {
  const Number front = a.begin()->second.is_negative() ? -content(a) : content(a);
  return scaled(a, {}, Number(1) / front);
}

int degree(const Polynomial& a, NodeId x) {
  int result = 0;
  for (const auto& [monomial, coefficient] : a) result = std::max(result, exponent_of(monomial, x));
  return result;
}

/// The symbols of a, the last made first: parameters stand behind coordinates in the arena.
std::vector<NodeId> symbols_of(const Polynomial& a) {
  std::vector<NodeId> symbols;
  for (const auto& [monomial, coefficient] : a) {
    for (const Atom& atom : monomial) symbols.push_back(atom.base);
  }
  std::ranges::sort(symbols);
  symbols.erase(std::unique(symbols.begin(), symbols.end()), symbols.end());
  return symbols;
}

/// The coefficients of the powers of x.
std::map<int, Polynomial> by_powers(const Polynomial& a, NodeId x) {
  std::map<int, Polynomial> parts;
  for (const auto& [monomial, coefficient] : a) {
    const int power = exponent_of(monomial, x);
    add(parts[power], times(monomial, x, -power), coefficient);
  }
  return parts;
}

Polynomial within_bounds(Polynomial a) {
  if (a.size() > most_terms_of_remainders)
    throw Error(ErrorCode::too_large, "the remainders of polynomials grow too large");
  return a;
}

Polynomial divisor_of(const Polynomial& a, const Polynomial& b);

Polynomial divided(const Polynomial& a, const Polynomial& b) { return is_one(b) ? a : *exact_quotient(a, b); }

/// A multiple of a less a multiple of b, of a smaller degree in x than b.
Polynomial remainder(Polynomial a, const Polynomial& b, NodeId x) {
  const int n = degree(b, x);
  const Polynomial leading = by_powers(b, x).at(n);
  while (!a.empty() && degree(a, x) >= n) {
    const int power = degree(a, x);
    const Polynomial top = scaled(by_powers(a, x).at(power), times({}, x, power - n), Number(1));
    Polynomial next = leading * a;
    add(next, top * b, Number(-1));
    a = next.empty() ? next : within_bounds(without_content(next));
  }
  return a;
}

/// Both have whole exponents and are not zero.
Polynomial divisor_of(const Polynomial& a, const Polynomial& b) {
  const std::vector<NodeId> of_a = symbols_of(a), of_b = symbols_of(b);
  if (of_a.empty() || of_b.empty()) return one;
  for (const NodeId x : of_a) {
    if (!std::ranges::binary_search(of_b, x)) return divisor_of(content_in(a, x), b);
  }
  for (const NodeId x : of_b) {
    if (!std::ranges::binary_search(of_a, x)) return divisor_of(a, content_in(b, x));
  }
  const NodeId x =
      *std::ranges::min_element(of_a, {}, [&](NodeId id) { return std::max(degree(a, id), degree(b, id)); });
  const Polynomial content_of_a = content_in(a, x), content_of_b = content_in(b, x);
  Polynomial p = divided(a, content_of_a), q = divided(b, content_of_b);
  if (degree(p, x) < degree(q, x)) std::swap(p, q);
  while (degree(q, x) > 0) {
    Polynomial rest = remainder(std::move(p), q, x);
    p = std::move(q);
    if (rest.empty()) return without_content(divisor_of(content_of_a, content_of_b) * p);
    q = divided(rest, content_in(rest, x));
  }
  return divisor_of(content_of_a, content_of_b);
}

/// number = outside^2 * inside, `inside` whole, as far as small primes tell.
std::pair<Number, Number> square_factors(const Number& number) {
  Number outside = Number(1) / number.denominator();
  Number inside = number.numerator() * number.denominator();
  for (std::int64_t prime = 2; prime < largest_prime_tried; ++prime) {
    const Number square(prime * prime);
    while ((inside / square).is_integer() && !inside.is_zero()) {
      inside = inside / square;
      outside = outside * Number(prime);
    }
  }
  if (const auto root = exact_root(inside); root && !root->is_zero()) return {outside * *root, Number(1)};
  return {outside, inside};
}

Polynomial slope(const Polynomial& a, NodeId x) {
  Polynomial result;
  for (const auto& [monomial, coefficient] : a) {
    if (const int power = exponent_of(monomial, x); power > 0)
      add(result, times(monomial, x, -1), coefficient * Number(power));
  }
  return result;
}

/// a with whole numbers in place of all symbols but x.
Polynomial along(const Polynomial& a, NodeId x) {
  Polynomial result;
  for (const auto& [monomial, coefficient] : a) {
    Number value = coefficient;
    for (const Atom& atom : monomial) {
      const std::int64_t number = 100 + atom.base % 97;
      if (atom.base != x) value = value * power(Number(number), atom.p);
    }
    add(result, times({}, x, exponent_of(monomial, x)), value);
  }
  return result;
}

/// Whether a factor with x in it may be there twice, which is so for all numbers in place of the others.
bool may_repeat(const Polynomial& a, NodeId x) {
  const Polynomial line = along(a, x);
  return degree(line, x) > 1 && degree(divisor_of(line, slope(line, x)), x) > 0;
}

/// A factor that is there twice in a, which has no monomial for a factor. a has in common with its derivative
/// the factors that it has more than once, each of them once less.
std::optional<Polynomial> repeated_factor(const Polynomial& a) {
  for (const NodeId x : symbols_of(a)) {
    if (!may_repeat(a, x)) continue;
    Polynomial common = divisor_of(a, slope(a, x));
    if (degree(common, x) == 0) continue;
    common = divided(common, content_in(common, x));  // which may be there but once
    if (const Polynomial more = divisor_of(common, slope(common, x)); degree(more, x) > 0)
      common = divided(common, more);
    if (exact_quotient(a, common * common)) return common;
  }
  return std::nullopt;
}

}  // namespace

Polynomial content_in(const Polynomial& a, NodeId x) {
  Polynomial common;
  for (const auto& [power, part] : by_powers(a, x)) {
    common = common.empty() ? without_content(part) : divisor_of(common, part);
    if (is_one(common)) break;
  }
  return common;
}

Number content(const Polynomial& a) {
  Number common(0);
  for (const auto& [monomial, coefficient] : a) common = gcd(common, coefficient);
  return common;
}

Polynomial greatest_common_divisor(const Polynomial& a, const Polynomial& b) {
  if (!has_whole_exponents(a) || !has_whole_exponents(b)) return one;
  return divisor_of(a, b);
}

SquareFactors square_factors(const Polynomial& a) {
  const auto [front, number] = square_factors(content(a));
  const Monomial common = common_monomial(a);
  Monomial outside, inside;
  for (const Atom& atom : common) {
    if (atom.q != 1) {
      inside.push_back(atom);
      continue;
    }
    const int odd = atom.p & 1;  // -3 is 2 * -2 + 1
    if (atom.p != odd) outside.push_back({atom.base, (atom.p - odd) / 2, 1});
    if (odd != 0) inside.push_back({atom.base, 1, 1});
  }
  SquareFactors result{{{outside, front}}, scaled(a, inverse(common), Number(1) / content(a))};
  while (result.inside.size() > 1 && has_whole_exponents(result.inside)) {
    const auto repeated = repeated_factor(result.inside);
    if (!repeated) break;
    result.outside = result.outside * *repeated;
    result.inside = *exact_quotient(result.inside, *repeated * *repeated);
  }
  result.inside = scaled(result.inside, inside, number);
  return result;
}

}  // namespace qdot
