#include "core/symmetry/residue.hpp"

#include <charconv>

namespace qdot {
namespace {

using Wide = unsigned __int128;

/// Of a whole number without sign, from its decimal.
Modular residue_of_digits(const Decimal& decimal) {
  Modular result;
  const Modular ten(10);
  for (const char c : decimal.digits) result = result * ten + Modular(static_cast<std::uint64_t>(c - '0'));
  return result * power(ten, static_cast<std::uint64_t>(decimal.exponent));
}

Modular residue_of_small(std::int64_t whole) {
  const Modular size(static_cast<std::uint64_t>(whole < 0 ? -whole : whole));
  return whole < 0 ? -size : size;
}

Modular residue_of_whole(const Number& whole) {
  const auto decimal = whole.decimal();
  const Modular size = decimal ? residue_of_digits(*decimal) : Modular();
  return whole.is_negative() ? -size : size;
}

}  // namespace

std::optional<Modular> Modular::of(const Number& number) {
  if (const auto small = number.small()) {
    const Modular above = residue_of_small(small->numerator);
    return small->denominator == 1 ? above : above * inverse(residue_of_small(small->denominator));
  }
  const Modular below = residue_of_whole(number.denominator());
  if (below.is_zero()) return std::nullopt;
  return residue_of_whole(number.numerator()) * inverse(below);
}

/// Euclid's algorithm for p and the residue, stopped halfway: Knuth, The Art of Computer Programming
/// 2, 4.5.3.
std::optional<Number> Modular::small_number() const {
  constexpr std::int64_t most = std::int64_t{1} << 27U;
  std::int64_t r = static_cast<std::int64_t>(prime), next = static_cast<std::int64_t>(value_);
  std::int64_t s = 0, next_s = 1;
  while (next > most) {
    const std::int64_t quotient = r / next;
    r -= quotient * next;
    s -= quotient * next_s;
    std::swap(r, next);
    std::swap(s, next_s);
  }
  if (next_s > most || next_s < -most || next_s == 0) return std::nullopt;
  return Number::ratio(next, next_s);
}

Modular operator*(Modular a, Modular b) {
  const Wide product = static_cast<Wide>(a.value_) * b.value_;
  const std::uint64_t low = static_cast<std::uint64_t>(product) & Modular::prime;
  const std::uint64_t sum = low + static_cast<std::uint64_t>(product >> 61U);
  return Modular::from(sum >= Modular::prime ? sum - Modular::prime : sum);
}

Modular power(Modular base, std::uint64_t exponent) {
  Modular result(1);
  for (; exponent != 0; exponent >>= 1U) {
    if (exponent % 2 == 1) result = result * base;
    base = base * base;
  }
  return result;
}

Modular inverse(Modular a) { return power(a, Modular::prime - 2); }

Residue operator*(Residue a, Residue b) {
  if (a.im.is_zero() && b.im.is_zero()) return {a.re * b.re, {}};
  return {a.re * b.re - a.im * b.im, a.re * b.im + a.im * b.re};
}

Residue inverse(Residue a) {
  if (a.im.is_zero()) return {inverse(a.re), {}};
  const Modular scale = inverse(a.re * a.re + a.im * a.im);
  return {a.re * scale, -a.im * scale};
}

std::optional<Residue> power(Residue a, int exponent) {
  if (exponent < 0) {
    if (a.is_zero()) return std::nullopt;
    return power(inverse(a), -exponent);
  }
  Residue result{Modular(1), {}};
  for (; exponent != 0; exponent /= 2) {
    if (exponent % 2 == 1) result = result * a;
    a = a * a;
  }
  return result;
}

namespace {

/// Modulo p = 3 (mod 4): a^((p + 1)/4) squared is a or -a.
std::optional<Modular> square_root(Modular a) {
  const Modular root = power(a, (Modular::prime + 1) / 4);
  if (root * root == a) return root;
  return std::nullopt;
}

}  // namespace

std::optional<Residue> square_root(Residue a) {
  if (a.im.is_zero()) {
    if (const auto root = square_root(a.re)) return Residue{*root, {}};
    return Residue{{}, *square_root(-a.re)};
  }
  const auto norm = square_root(a.re * a.re + a.im * a.im);
  if (!norm) return std::nullopt;
  const Modular half = inverse(Modular(2));
  auto re = square_root((a.re + *norm) * half);
  if (!re) re = square_root((a.re - *norm) * half);
  if (!re || re->is_zero()) return std::nullopt;
  return Residue{*re, a.im * half * inverse(*re)};
}

}  // namespace qdot
