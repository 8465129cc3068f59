#pragma once
// Exact arithmetic in which every number takes two words: a + b i with a, b modulo the prime p = 2^61 - 1.
// Since p = 3 (mod 4), -1 has no square root modulo p, so these are the field of p^2 elements, in which every
// a modulo p has a square root. Sums and products of rational numbers become those of their residues: a
// linear dependence among expressions is one among residues, and one that only residues have is a chance of
// some 2^-61 for each place where they are tried.
// Source: Lidl, Niederreiter, Finite Fields, 2nd ed., 2.1.

#include <cstdint>
#include <optional>

#include "core/expr/number.hpp"

namespace qdot {

/// Modulo p.
class Modular {
 public:
  static constexpr std::uint64_t prime = (std::uint64_t{1} << 61U) - 1;

  Modular() = default;
  explicit Modular(std::uint64_t value) : value_(value % prime) {}
  /// None where p divides the denominator.
  [[nodiscard]] static std::optional<Modular> of(const Number& number);

  [[nodiscard]] bool is_zero() const { return value_ == 0; }
  /// The rational number with small numerator and denominator that it is the residue of, if there is one.
  [[nodiscard]] std::optional<Number> small_number() const;

  friend Modular operator+(Modular a, Modular b) {
    const std::uint64_t sum = a.value_ + b.value_;
    return from(sum >= prime ? sum - prime : sum);
  }
  friend Modular operator-(Modular a) { return from(a.value_ == 0 ? 0 : prime - a.value_); }
  friend Modular operator-(Modular a, Modular b) { return a + -b; }
  friend Modular operator*(Modular a, Modular b);
  friend bool operator==(Modular a, Modular b) = default;

 private:
  [[nodiscard]] static Modular from(std::uint64_t value) {
    Modular result;
    result.value_ = value;
    return result;
  }

  std::uint64_t value_{0};
};

[[nodiscard]] Modular power(Modular base, std::uint64_t exponent);
/// a != 0.
[[nodiscard]] Modular inverse(Modular a);

/// re + im i.
struct Residue {
  Modular re, im;

  [[nodiscard]] bool is_zero() const { return re.is_zero() && im.is_zero(); }
};

[[nodiscard]] inline Residue operator+(Residue a, Residue b) { return {a.re + b.re, a.im + b.im}; }
[[nodiscard]] inline Residue operator-(Residue a, Residue b) { return {a.re - b.re, a.im - b.im}; }
[[nodiscard]] Residue operator*(Residue a, Residue b);
/// a != 0.
[[nodiscard]] Residue inverse(Residue a);
/// None where a = 0 and the exponent is negative.
[[nodiscard]] std::optional<Residue> power(Residue a, int exponent);
[[nodiscard]] std::optional<Residue> square_root(Residue a);

}  // namespace qdot
