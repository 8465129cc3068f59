#pragma once
// Numbers in expressions: exact rationals p/q while |p|, q <= 2^53, the nearest double afterwards.

#include <compare>
#include <cstdint>

namespace qdot {

/// Integers up to here are doubles, and so are their neighbours: numerators and denominators go no further.
inline constexpr std::int64_t largest_exact = std::int64_t{1} << 53;

class Number {
 public:
  constexpr Number() = default;
  constexpr Number(std::int64_t integer) : numerator_(integer) {}  // NOLINT: integers are numbers
  /// p/q in lowest terms; q != 0.
  [[nodiscard]] static Number ratio(std::int64_t p, std::int64_t q);
  [[nodiscard]] static Number real(double value);

  [[nodiscard]] bool is_exact() const { return denominator_ != 0; }
  [[nodiscard]] bool is_integer() const { return denominator_ == 1; }
  [[nodiscard]] bool is_zero() const { return value() == 0; }
  [[nodiscard]] bool is_one() const { return denominator_ == 1 && numerator_ == 1; }
  [[nodiscard]] bool is_negative() const { return value() < 0; }
  /// Of an exact number.
  [[nodiscard]] std::int64_t numerator() const { return numerator_; }
  [[nodiscard]] std::int64_t denominator() const { return denominator_; }
  [[nodiscard]] double value() const {
    return is_exact() ? static_cast<double>(numerator_) / static_cast<double>(denominator_) : real_;
  }

  friend Number operator+(const Number& a, const Number& b);
  friend Number operator-(const Number& a) { return a * Number(-1); }
  friend Number operator-(const Number& a, const Number& b) { return a + -b; }
  friend Number operator*(const Number& a, const Number& b);
  /// b != 0.
  friend Number operator/(const Number& a, const Number& b);
  friend bool operator==(const Number& a, const Number& b) = default;
  friend bool operator<(const Number& a, const Number& b) { return a.value() < b.value(); }

 private:
  std::int64_t numerator_{0};
  std::int64_t denominator_{1};  // 0 marks a real
  double real_{0};
};

/// base^exponent; base != 0 when exponent < 0.
[[nodiscard]] Number power(const Number& base, int exponent);

/// Greatest common divisor of two exact numbers: the largest r >= 0 with a/r and b/r integers; 1
/// where r would not be exact.
[[nodiscard]] Number gcd(const Number& a, const Number& b);

}  // namespace qdot
