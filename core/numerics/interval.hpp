#pragma once
// Interval arithmetic: every operation encloses the results of all pairs of numbers in its operands, rounding
// included, so a value computed from exact inputs is known to lie between `lower` and `upper`. What is
// undefined somewhere in an operand (1/[-1, 1], the square root of a negative number) is the whole line.
// Source: Moore, Kearfott, Cloud, Introduction to Interval Analysis (2009), chapters 2, 4 and 5.

#include <limits>

#include "core/numerics/function.hpp"
#include "core/numerics/real.hpp"

namespace qdot {

struct Interval {
  double lower{};
  double upper{};

  Interval() = default;
  Interval(double value) : lower(value), upper(value) {}  // implicit: a number is an interval
  Interval(double lower_end, double upper_end) : lower(lower_end), upper(upper_end) {}
  /// The doubles next to each other that a real number lies between; one where it is a double.
  [[nodiscard]] static Interval literal(const Real& value);
  [[nodiscard]] static Interval whole() {
    return {-std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity()};
  }

  [[nodiscard]] bool contains(double x) const { return lower <= x && x <= upper; }
  [[nodiscard]] bool contains(const Interval& x) const { return lower <= x.lower && x.upper <= upper; }
  [[nodiscard]] bool is_finite() const;
  /// A finite number inside, also of an interval that is not bounded.
  [[nodiscard]] double middle() const;
  [[nodiscard]] double width() const { return upper - lower; }
  /// Largest distance of a point of the interval from middle().
  [[nodiscard]] double radius() const;
  /// Largest and least absolute value.
  [[nodiscard]] double magnitude() const;
  [[nodiscard]] double least_magnitude() const;
};

[[nodiscard]] Interval operator+(const Interval& a, const Interval& b);
[[nodiscard]] Interval operator-(const Interval& a, const Interval& b);
[[nodiscard]] Interval operator-(const Interval& a);
[[nodiscard]] Interval operator*(const Interval& a, const Interval& b);
[[nodiscard]] Interval operator/(const Interval& a, const Interval& b);

/// The squares of all numbers in a. It is never below zero, which a * a, whose operands vary apart, can be.
[[nodiscard]] Interval square(const Interval& a);
[[nodiscard]] Interval sqrt(const Interval& a);
[[nodiscard]] Interval sin(const Interval& a);
[[nodiscard]] Interval cos(const Interval& a);
/// a^exponent for a >= 0 or a whole exponent.
[[nodiscard]] Interval power(const Interval& a, const Interval& exponent);
[[nodiscard]] Interval evaluate(Function function, const Interval& argument);

/// The smallest interval that holds both.
[[nodiscard]] Interval hull(const Interval& a, const Interval& b);
/// What both hold; lower > upper where that is nothing.
[[nodiscard]] Interval intersection(const Interval& a, const Interval& b);
/// The number 0, exactly.
[[nodiscard]] inline bool is_zero(const Interval& a) { return a.lower == 0 && a.upper == 0; }
[[nodiscard]] inline bool is_empty(const Interval& a) { return !(a.lower <= a.upper); }

}  // namespace qdot
