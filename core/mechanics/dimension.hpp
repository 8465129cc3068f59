#pragma once
// Physical dimensions and what a unit is. A dimension is a product of powers of the four SI base units
// that mechanics with charges needs: kg, m, s, A. Exponents are rational, so that sqrt(l/g) has one.
//
// Angles have no dimension: rad = 1, as in the SI Brochure (9th edition, section 2.3.4). Whether a unit
// speaks of angles at all is kept beside its dimension, because "2 Hz" said of an angular velocity means 4 pi
// rad/s.

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "core/expr/number.hpp"

namespace qdot {

/// A rational number in lowest terms, denominator > 0.
struct Exponent {
  int numerator{0};
  int denominator{1};

  friend bool operator==(const Exponent&, const Exponent&) = default;
};

/// Lowest terms; beyond a million in either part the value is kept and the precision dropped.
[[nodiscard]] Exponent reduced(std::int64_t numerator, std::int64_t denominator);

/// kg^a m^b s^c A^d. The default value is "no dimension", which prints as "1".
struct Dimension {
  std::array<Exponent, 4> exponents{};  ///< of kg, m, s, A

  [[nodiscard]] bool is_dimensionless() const { return *this == Dimension{}; }
  friend bool operator==(const Dimension&, const Dimension&) = default;
};

[[nodiscard]] Dimension operator*(const Dimension& a, const Dimension& b);
[[nodiscard]] Dimension operator/(const Dimension& a, const Dimension& b);

/// d^(numerator/denominator), denominator != 0: sqrt is pow(d, 1, 2). Total: an exponent beyond a million,
/// which no physics has, is held there instead of overflowing.
[[nodiscard]] Dimension pow(const Dimension& d, int numerator, int denominator = 1);

/// "kg*m/s^2", "1/s", "m^(1/2)", "kg*m^2/(s^3*A)"; "1" for none. parse_unit reads it back.
[[nodiscard]] std::string to_text(const Dimension& d);

/// A unit: value in SI = value in this unit * factor * pi^pi_power. So 35 cm is 7/20 m exactly, and of
/// 30 deg = pi/6 it is known what rounding leaves out.
struct Unit {
  Number factor{1};
  Dimension dimension{};
  int pi_power{0};
  int angle{0};   ///< net power of rad, deg and rev in it: 1 for "rad/s" and "rpm"
  int cycles{0};  ///< net power of Hz in it

  [[nodiscard]] Real to_si(const Number& value) const;
  /// Are numbers in this unit SI numbers already? A scene declares its symbols in such units only.
  [[nodiscard]] bool is_coherent() const { return factor.is_one() && pi_power == 0; }
};

}  // namespace qdot
