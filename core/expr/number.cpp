#include "core/expr/number.hpp"

#include <cmath>
#include <numeric>

namespace qdot {
namespace {

using Wide = __int128;

Wide greatest_divisor(Wide a, Wide b) {
  if (a < 0) a = -a;
  while (b != 0) {
    const Wide rest = a % b;
    a = b;
    b = rest;
  }
  return a;
}

Number reduced(Wide p, Wide q) {
  if (q == 1 && p <= largest_exact && -p <= largest_exact) return Number(static_cast<std::int64_t>(p));
  if (q < 0) {
    p = -p;
    q = -q;
  }
  const Wide divisor = greatest_divisor(p, q);
  p /= divisor;
  q /= divisor;
  if (p > largest_exact || -p > largest_exact || q > largest_exact) {
    return Number::real(static_cast<double>(p) / static_cast<double>(q));
  }
  return Number::ratio(static_cast<std::int64_t>(p), static_cast<std::int64_t>(q));
}

}  // namespace

Number Number::ratio(std::int64_t p, std::int64_t q) {
  const std::int64_t divisor = std::gcd(p, q) * (q < 0 ? -1 : 1);
  Number result;
  result.numerator_ = p / divisor;
  result.denominator_ = q / divisor;
  return result;
}

Number Number::real(double value) {
  if (std::abs(value) <= static_cast<double>(largest_exact) && value == std::floor(value)) {
    return Number(static_cast<std::int64_t>(value));
  }
  Number result;
  result.denominator_ = 0;
  result.real_ = value;
  return result;
}

Number operator+(const Number& a, const Number& b) {
  if (!a.is_exact() || !b.is_exact()) return Number::real(a.value() + b.value());
  return reduced(Wide{a.numerator()} * b.denominator() + Wide{b.numerator()} * a.denominator(),
                 Wide{a.denominator()} * b.denominator());
}

Number operator*(const Number& a, const Number& b) {
  if (!a.is_exact() || !b.is_exact()) return Number::real(a.value() * b.value());
  return reduced(Wide{a.numerator()} * b.numerator(), Wide{a.denominator()} * b.denominator());
}

Number operator/(const Number& a, const Number& b) {
  if (!a.is_exact() || !b.is_exact()) return Number::real(a.value() / b.value());
  return reduced(Wide{a.numerator()} * b.denominator(), Wide{a.denominator()} * b.numerator());
}

Number power(const Number& base, int exponent) {
  Number result(1);
  for (int i = 0; i < std::abs(exponent); ++i) result = result * base;
  return exponent < 0 ? Number(1) / result : result;
}

Number gcd(const Number& a, const Number& b) {
  const std::int64_t shared = std::gcd(a.denominator(), b.denominator());
  const Wide denominator = Wide{a.denominator()} / shared * b.denominator();
  if (denominator > largest_exact) return Number(1);
  return Number::ratio(std::gcd(a.numerator(), b.numerator()), static_cast<std::int64_t>(denominator));
}

}  // namespace qdot
