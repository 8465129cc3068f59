#pragma once
// Numbers in expressions: exact rationals. Nothing is rounded before a number reaches a tape, and there
// rounded() says what rounding left out. Small ones, |p| and q <= 2^53, are two integers; the others are
// GMP's.

#include <cstdint>
#include <memory>
#include <optional>
#include <string_view>

#include "core/expr/decimal.hpp"
#include "core/numerics/real.hpp"

namespace qdot {

/// p/q in lowest terms, q > 0.
struct Fraction {
  std::int64_t numerator{0};
  std::int64_t denominator{1};
  friend bool operator==(const Fraction&, const Fraction&) = default;
};

class Number {
 public:
  /// Of numerator and of denominator.
  static constexpr std::size_t most_bits = 1 << 13;

  Number() = default;
  Number(std::int64_t integer);  // NOLINT: integers are numbers
  /// p/q; q != 0.
  [[nodiscard]] static Number ratio(std::int64_t p, std::int64_t q);
  /// What a finite double stands for, exactly.
  [[nodiscard]] static Number real(double value);
  /// The number that `text` writes, such as "12", "1.5", ".5e-3"; no sign. None for anything else, and for
  /// what is beyond double precision.
  [[nodiscard]] static std::optional<Number> written(std::string_view text);

  [[nodiscard]] bool is_integer() const;
  [[nodiscard]] bool is_zero() const { return large_ == nullptr && small_.numerator == 0; }
  [[nodiscard]] bool is_one() const { return large_ == nullptr && small_ == Fraction{1, 1}; }
  [[nodiscard]] bool is_negative() const { return sign() < 0; }
  [[nodiscard]] int sign() const;
  /// In 64 bits, if it is an integer of at most this size.
  [[nodiscard]] std::optional<std::int64_t> whole(std::int64_t most) const;
  /// In 64 bits, where both |p| and q are at most 2^53.
  [[nodiscard]] std::optional<Fraction> small() const;
  [[nodiscard]] Number numerator() const;
  [[nodiscard]] Number denominator() const;
  /// The decimal with finitely many digits that |number| is, if it is one.
  [[nodiscard]] std::optional<Decimal> decimal() const;
  /// Bits of the larger of numerator and denominator.
  [[nodiscard]] std::size_t bits() const;
  [[nodiscard]] std::size_t hash() const;

  /// The nearest double, infinite beyond their range.
  [[nodiscard]] double value() const;
  /// The nearest double, and what it leaves out.
  [[nodiscard]] Real rounded() const;

  // All throw Error(too_large) where the result would have more than most_bits.
  friend Number operator+(const Number& a, const Number& b);
  friend Number operator-(const Number& a);
  friend Number operator-(const Number& a, const Number& b) { return a + -b; }
  friend Number operator*(const Number& a, const Number& b);
  /// b != 0.
  friend Number operator/(const Number& a, const Number& b);
  friend bool operator==(const Number& a, const Number& b);
  friend bool operator<(const Number& a, const Number& b);
  friend Number power(const Number& base, int exponent);
  friend Number gcd(const Number& a, const Number& b);
  friend std::optional<Number> exact_root(const Number& square);

 private:
  struct Large;
  friend struct Arithmetic;

  Fraction small_{};  ///< where there is no large one
  std::shared_ptr<const Large> large_;
};

/// base^exponent; base != 0 when exponent < 0.
[[nodiscard]] Number power(const Number& base, int exponent);

/// Greatest common divisor: the largest r >= 0 with a/r and b/r integers.
[[nodiscard]] Number gcd(const Number& a, const Number& b);

/// The rational r >= 0 with r^2 = square, if there is one.
[[nodiscard]] std::optional<Number> exact_root(const Number& square);

}  // namespace qdot
