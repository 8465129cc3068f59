#include "core/numerics/log_interval.hpp"

#include <algorithm>
#include <cmath>

#include "core/numerics/constants.hpp"

namespace qdot {
namespace {

using End = LogInterval::End;

/// Every logarithm is computed from others by a few operations, each within some units of 2^-52 of the
/// largest of them, or of one.
double slack(double ln) { return (1 + std::abs(ln)) * 0x1p-46; }

End zero() { return {0, -infinity}; }

/// Not above, or not below, the number meant: `up` says which.
End rounded(End x, bool up) {
  if (x.sign == 0 || std::isinf(x.ln)) return x;
  x.ln += (x.sign > 0) == up ? slack(x.ln) : -slack(x.ln);
  return x;
}

bool less(const End& a, const End& b) {
  if (a.sign != b.sign) return a.sign < b.sign;
  return a.sign > 0 ? a.ln < b.ln : a.sign < 0 && a.ln > b.ln;
}

End opposite(const End& a) { return {-a.sign, a.ln}; }

/// The logarithm of the sum, or difference, of two positive numbers, from above or below.
double joined(double more, double fewer, bool subtract, bool up) {
  if (std::isinf(more)) return more;
  const double share = std::isinf(fewer) ? 0 : evaluate(Function::exp, fewer - more);  // of the larger
  if (!subtract) return more + evaluate(Function::log, 1 + share);
  const double unsure = (share > 0 ? share * (1 + more - fewer) * 0x1p-50 : 0) + 0x1p-52;
  const double rest = 1 - share + (up ? unsure : -unsure);
  return rest > 0 ? more + evaluate(Function::log, std::min(rest, 1.0)) : -infinity;
}

End sum(const End& a, const End& b, bool up) {
  if (a.sign == 0) return b;
  if (b.sign == 0) return a;
  const bool a_leads = a.ln >= b.ln;
  const End& more = a_leads ? a : b;
  const End& fewer = a_leads ? b : a;
  if (a.sign == b.sign) return rounded({a.sign, joined(more.ln, fewer.ln, false, up)}, up);
  if (a.ln == b.ln) {
    if (std::isfinite(a.ln)) return zero();
    // Both without bound, or both as near zero as one likes.
    return a.ln > 0 ? End{up ? 1 : -1, infinity} : End{up ? 1 : -1, -infinity};
  }
  const bool away = (more.sign > 0) == up;  // from zero
  End result{more.sign, joined(more.ln, fewer.ln, true, away)};
  if (std::isinf(result.ln) && result.ln < 0 && !away) return zero();
  return rounded(result, up);
}

/// Numbers that are members are finite and, with ln = -infinity, not zero: their product is neither.
End product(const End& a, const End& b, bool up) {
  const int sign = a.sign * b.sign;
  if (sign == 0) return zero();
  const bool away = (sign > 0) == up;
  const double ln = a.ln + b.ln;
  return rounded({sign, std::isnan(ln) ? (away ? infinity : -infinity) : ln}, up);
}

End reciprocal(const End& a) { return {a.sign, -a.ln}; }

template <class Of>
LogInterval range(const Of& of) {
  End least = of(0, false), most = of(0, true);
  for (int i = 1; i < 4; ++i) {
    if (const End low = of(i, false); less(low, least)) least = low;
    if (const End high = of(i, true); less(most, high)) most = high;
  }
  return {least, most};
}

End end_of(double x, bool up) {
  if (x == 0) return zero();
  const double ln = std::isinf(x) ? infinity : evaluate(Function::log, std::abs(x));
  return rounded({x > 0 ? 1 : -1, ln}, up);
}

/// exp(ln) in doubles; past their range the largest number, or infinity.
double magnitude(double ln, bool up) {
  constexpr double largest_exponent = 709;
  constexpr double least_exponent = -708;
  if (ln > largest_exponent) return up ? infinity : std::numeric_limits<double>::max() / 4;
  if (ln < least_exponent) return up ? std::numeric_limits<double>::min() : 0;
  const double value = evaluate(Function::exp, ln);
  const double unit = (1 + std::abs(ln)) * 0x1p-51;
  return up ? value * (1 + unit) : value * (1 - unit);
}

double number(const End& x, bool up) {
  if (x.sign == 0) return 0;
  const bool away = (x.sign > 0) == up;
  return x.sign * magnitude(x.ln, away);
}

LogInterval exponential(const LogInterval& a) {
  const Interval x = a.interval();
  return {{1, std::isinf(x.lower) ? -infinity : x.lower - slack(x.lower)},
          {1, std::isinf(x.upper) ? infinity : x.upper + slack(x.upper)}};
}

LogInterval of_positive(const LogInterval& a, double exponent) {
  const auto raised = [&](const End& x, bool up) {
    if (x.sign == 0) return exponent > 0 ? zero() : End{1, infinity};
    return rounded({1, x.ln * exponent}, up);
  };
  return exponent > 0 ? LogInterval{raised(a.lower, false), raised(a.upper, true)}
                      : LogInterval{raised(a.upper, false), raised(a.lower, true)};
}

LogInterval absolute(const LogInterval& a) {
  if (a.lower.sign >= 0) return a;
  if (a.upper.sign <= 0) return -a;
  const End low = opposite(a.lower);
  return {zero(), less(low, a.upper) ? a.upper : low};
}

}  // namespace

LogInterval::LogInterval(const Interval& x) : lower(end_of(x.lower, false)), upper(end_of(x.upper, true)) {}

Interval LogInterval::interval() const { return {number(lower, false), number(upper, true)}; }

LogInterval operator+(const LogInterval& a, const LogInterval& b) {
  return {sum(a.lower, b.lower, false), sum(a.upper, b.upper, true)};
}

LogInterval operator-(const LogInterval& a) { return {opposite(a.upper), opposite(a.lower)}; }

LogInterval operator*(const LogInterval& a, const LogInterval& b) {
  return range([&](int i, bool up) {
    return product(i % 2 == 0 ? a.lower : a.upper, i / 2 == 0 ? b.lower : b.upper, up);
  });
}

LogInterval operator/(const LogInterval& a, const LogInterval& b) {
  if (b.contains_zero()) return LogInterval::whole();
  return a * LogInterval{reciprocal(b.upper), reciprocal(b.lower)};
}

LogInterval square(const LogInterval& a) { return of_positive(absolute(a), 2); }

LogInterval sqrt(const LogInterval& a) { return power(a, 0.5); }

LogInterval sin(const LogInterval& a) { return evaluate(Function::sin, a); }
LogInterval cos(const LogInterval& a) { return evaluate(Function::cos, a); }

LogInterval power(const LogInterval& a, const Real& exact) {
  if (!exact.is_exact()) {
    return evaluate(Function::exp, LogInterval::literal(exact) * evaluate(Function::log, a));
  }
  const double exponent = exact.value;
  const bool whole = exponent == std::nearbyint(exponent);
  if (a.lower.sign < 0 && !whole) return LogInterval::whole();
  if (exponent < 0 && a.contains_zero()) return LogInterval::whole();
  if (a.lower.sign >= 0) return of_positive(a, exponent);
  const bool odd = std::fmod(std::abs(exponent), 2) == 1;
  if (!odd) return of_positive(absolute(a), exponent);
  if (a.upper.sign <= 0) return -of_positive(-a, exponent);
  return {opposite(of_positive({zero(), opposite(a.lower)}, exponent).upper),
          of_positive({zero(), a.upper}, exponent).upper};
}

LogInterval evaluate(Function function, const LogInterval& a) {
  const LogInterval half = LogInterval::literal(0.5);
  switch (function) {
    case Function::exp:
      return exponential(a);
    case Function::cosh:
      return half * (exponential(absolute(a)) + exponential(-absolute(a)));
    case Function::sinh:
      if (a.contains_zero()) break;
      return half * (exponential(a) + -exponential(-a));
    case Function::abs:
      return absolute(a);
    case Function::log:
      if (a.lower.sign <= 0) return LogInterval::whole();
      return LogInterval(Interval(a.lower.ln, a.upper.ln));
    default:
      break;
  }
  return LogInterval(evaluate(function, a.interval()));
}

}  // namespace qdot
