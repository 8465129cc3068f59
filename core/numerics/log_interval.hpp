#pragma once
// Intervals of numbers of any size: their ends are sign and logarithm, so that exp(-1e15) is neither zero nor
// forgotten to be positive. They are coarse where numbers cancel; their use is the sign of what an interval
// of doubles cannot tell from zero, such as a force that falls off exponentially. For TapeEvaluator.
// Source: the operations are those of core/numerics/interval.hpp, on exp(ln x) instead of x.

#include "core/numerics/interval.hpp"

namespace qdot {

struct LogInterval {
  /// sign exp(ln). ln = -infinity with a sign is the end of an open interval at 0: what lies inside is not 0.
  struct End {
    int sign{};
    double ln{};
  };
  End lower, upper;

  LogInterval() = default;
  LogInterval(const End& lower_end, const End& upper_end) : lower(lower_end), upper(upper_end) {}
  explicit LogInterval(const Interval& x);
  [[nodiscard]] static LogInterval literal(const Real& value) {
    return LogInterval(Interval::literal(value));
  }
  [[nodiscard]] static LogInterval whole() { return LogInterval(Interval::whole()); }

  /// 0 is a member.
  [[nodiscard]] bool contains_zero() const { return lower.sign <= 0 && upper.sign >= 0; }
  /// As doubles, rounded outward.
  [[nodiscard]] Interval interval() const;
};

[[nodiscard]] LogInterval operator+(const LogInterval& a, const LogInterval& b);
[[nodiscard]] LogInterval operator-(const LogInterval& a);
[[nodiscard]] LogInterval operator*(const LogInterval& a, const LogInterval& b);
[[nodiscard]] LogInterval operator/(const LogInterval& a, const LogInterval& b);
[[nodiscard]] LogInterval square(const LogInterval& a);
[[nodiscard]] LogInterval sqrt(const LogInterval& a);
[[nodiscard]] LogInterval sin(const LogInterval& a);
[[nodiscard]] LogInterval cos(const LogInterval& a);
[[nodiscard]] LogInterval power(const LogInterval& a, const Real& exponent);
[[nodiscard]] LogInterval evaluate(Function function, const LogInterval& a);

}  // namespace qdot
