#include "core/mechanics/dimension.hpp"

#include <algorithm>
#include <cassert>
#include <numeric>
#include <string_view>

#include "core/numerics/ball.hpp"

namespace qdot {
namespace {

constexpr std::array<std::string_view, 4> base_names{"kg", "m", "s", "A"};

Exponent sum(Exponent a, Exponent b, int sign) {
  const std::int64_t denominator = std::int64_t{a.denominator} * b.denominator;
  return reduced(std::int64_t{a.numerator} * b.denominator + sign * std::int64_t{b.numerator} * a.denominator,
                 denominator);
}

/// "m", "m^2", "m^(1/2)"
std::string power_text(std::string_view name, Exponent exponent) {
  std::string text(name);
  if (exponent == Exponent{1, 1}) return text;
  const std::string numerator = std::to_string(exponent.numerator);
  if (exponent.denominator == 1) return text + "^" + numerator;
  return text + "^(" + numerator + "/" + std::to_string(exponent.denominator) + ")";
}

}  // namespace

Exponent reduced(std::int64_t numerator, std::int64_t denominator) {
  constexpr std::int64_t limit = 1'000'000;
  if (denominator < 0) {
    numerator = -numerator;
    denominator = -denominator;
  }
  const std::int64_t divisor = std::max<std::int64_t>(std::gcd(numerator, denominator), 1);
  numerator /= divisor;
  denominator /= divisor;
  while (denominator > limit) {
    numerator /= 2;
    denominator /= 2;
  }
  numerator = std::clamp(numerator, -limit, limit);
  const std::int64_t rest = std::max<std::int64_t>(std::gcd(numerator, denominator), 1);
  return {static_cast<int>(numerator / rest), static_cast<int>(denominator / rest)};
}

Dimension operator*(const Dimension& a, const Dimension& b) {
  Dimension result;
  for (std::size_t i = 0; i < result.exponents.size(); ++i) {
    result.exponents[i] = sum(a.exponents[i], b.exponents[i], +1);
  }
  return result;
}

Dimension operator/(const Dimension& a, const Dimension& b) {
  Dimension result;
  for (std::size_t i = 0; i < result.exponents.size(); ++i) {
    result.exponents[i] = sum(a.exponents[i], b.exponents[i], -1);
  }
  return result;
}

Dimension pow(const Dimension& d, int numerator, int denominator) {
  assert(denominator != 0);
  Dimension result;
  for (std::size_t i = 0; i < result.exponents.size(); ++i) {
    result.exponents[i] = reduced(std::int64_t{d.exponents[i].numerator} * numerator,
                                  std::int64_t{d.exponents[i].denominator} * denominator);
  }
  return result;
}

Real Unit::to_si(const Number& value) const {
  const Number rational = value * factor;
  if (pi_power == 0 || rational.is_zero()) return rational.rounded();
  return (Ball::literal(rational.rounded()) * power(Ball::literal(exact_pi), Ball(pi_power))).real();
}

std::string to_text(const Dimension& d) {
  std::string above;
  std::string below;
  int factors_below = 0;
  for (std::size_t i = 0; i < base_names.size(); ++i) {
    const Exponent exponent = d.exponents[i];
    if (exponent.numerator > 0) {
      above += (above.empty() ? "" : "*") + power_text(base_names[i], exponent);
    } else if (exponent.numerator < 0) {
      below +=
          (below.empty() ? "" : "*") + power_text(base_names[i], {-exponent.numerator, exponent.denominator});
      ++factors_below;
    }
  }
  if (above.empty()) above = "1";
  if (below.empty()) return above;
  return above + "/" + (factors_below > 1 ? "(" + below + ")" : below);
}

}  // namespace qdot
