#pragma once
// A real number beside the double that stands for it: 1/10 is not a double, and what the double leaves out
// is kept. Intervals and balls hold the number itself, and double-double arithmetic starts from twice the
// digits.

#include <cmath>
#include <compare>
#include <concepts>
#include <span>
#include <vector>

#include "core/numerics/constants.hpp"
#include "core/numerics/double_double.hpp"

namespace qdot {

/// A number x with |x - value - low| <= error. `value` is the double nearest to it, or within a few units in
/// the last place of that; beyond the range of doubles it is infinite.
struct Real {
  double value{};
  double low{};
  double error{};

  constexpr Real() = default;
  constexpr Real(double exact) : value(exact) {}  // implicit: a double is a real number
  constexpr Real(double value_of, double low_part, double error_bound)
      : value(value_of), low(low_part), error(error_bound) {}

  [[nodiscard]] constexpr bool is_exact() const { return low == 0 && error == 0; }
  /// Whether fewer digits of it are known than doubles have, as where large numbers have cancelled.
  [[nodiscard]] bool has_lost_digits() const { return error > 0x1p-60 * std::abs(value); }
  [[nodiscard]] bool is_finite() const { return std::isfinite(value) && std::isfinite(error); }
  [[nodiscard]] DoubleDouble double_double() const { return two_sum(value, low); }

  friend auto operator<=>(const Real&, const Real&) = default;
};

/// pi = 3.14159265358979311600 + 1.2246467991473531772e-16 - 2.99e-33.
inline constexpr Real exact_pi{pi, 1.2246467991473532e-16, 3e-33};

/// Real numbers in order, such as a model's parameters. Whoever computes in doubles takes it for a vector of
/// them; as<Interval>() and as<Ball>() hold the numbers themselves.
class Reals {
 public:
  Reals() = default;
  /// Doubles are exact.
  template <std::convertible_to<std::span<const double>> Doubles>
  requires(!std::same_as<Doubles, Reals>)
      Reals(const Doubles& doubles) {  // NOLINT: implicit, as a double is a Real
    for (const double x : std::span<const double>(doubles)) push_back(x);
  }

  void push_back(const Real& x) {
    values_.push_back(x.value);
    exact_.push_back(x);
  }
  void set(std::size_t i, const Real& x) {
    values_[i] = x.value;
    exact_[i] = x;
  }

  // A range of doubles.
  using value_type = double;
  using const_iterator = std::vector<double>::const_iterator;
  [[nodiscard]] std::size_t size() const { return values_.size(); }
  [[nodiscard]] double operator[](std::size_t i) const { return values_[i]; }
  [[nodiscard]] const double* data() const { return values_.data(); }
  [[nodiscard]] auto begin() const { return values_.begin(); }
  [[nodiscard]] auto end() const { return values_.end(); }
  operator std::vector<double>() const { return values_; }  // NOLINT: as above

  [[nodiscard]] const Real& exact(std::size_t i) const { return exact_[i]; }
  /// As numbers of an arithmetic that has T::literal.
  template <class T>
  [[nodiscard]] std::vector<T> as() const {
    std::vector<T> result;
    result.reserve(size());
    for (const Real& x : exact_) result.push_back(T::literal(x));
    return result;
  }

 private:
  std::vector<double> values_;
  std::vector<Real> exact_;
};

}  // namespace qdot
