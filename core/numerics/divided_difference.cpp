#include "core/numerics/divided_difference.hpp"

#include <sleef.h>

#include <algorithm>
#include <cmath>

#include "core/numerics/whole_power.hpp"

namespace qdot {
namespace {

bool is_constant(const DividedDifference& u) { return u.slope.lower == 0 && u.slope.upper == 0; }

/// 0 + x and 1 x would be rounded once more.
Interval sum(const Interval& a, const Interval& b) {
  if (a.lower == 0 && a.upper == 0) return b;
  return b.lower == 0 && b.upper == 0 ? a : a + b;
}
Interval product(const Interval& a, const Interval& b) {
  if (a.lower == 1 && a.upper == 1) return b;
  return b.lower == 1 && b.upper == 1 ? a : a * b;
}

Interval half(const Interval& a) { return a * Interval(0.5); }
Interval middle(const DividedDifference& u) { return half(u.at_a + u.at_b); }
Interval change(const DividedDifference& u) { return u.at_b - u.at_a; }

/// f(x)/x, even, for an odd f whose quotient falls or rises with |x| all the way to `to`.
template <class Odd>
Interval even_quotient(Odd f, const Interval& x) {
  const auto at = [&](double size) { return size == 0 ? Interval(1) : f(Interval(size)) / Interval(size); };
  return hull(at(x.least_magnitude()), at(x.magnitude()));
}

/// sin(x)/x; it falls from 1 as far as 4.49, where it is least.
Interval sinc(const Interval& x) {
  constexpr double least = -0.217234;
  if (!x.is_finite()) return {least, 1};
  if (x.magnitude() > 4.4) {
    const Interval everywhere(least, 1);
    return x.contains(0.0) ? everywhere : intersection(sin(x) / x, everywhere);
  }
  return even_quotient([](const Interval& y) { return sin(y); }, x);
}

Interval sinhc(const Interval& x) {
  return even_quotient([](const Interval& y) { return evaluate(Function::sinh, y); }, x);
}

Interval atanc(const Interval& x) {
  return even_quotient([](const Interval& y) { return evaluate(Function::atan, y); }, x);
}

/// atanh(x)/x for |x| < 1. atanh, too, is within a unit in the last place.
Interval atanhc(const Interval& x) {
  if (!(x.magnitude() < 1)) return Interval::whole();
  return even_quotient(
      [](const Interval& y) {
        const double value = Sleef_cinz_atanhd1_u10purec(y.lower);
        constexpr double two_units = 0x1p-51;
        return Interval(value * (1 - two_units), value * (1 + two_units));
      },
      x);
}

/// (f(v) - f(u))/(v - u): as a quotient, and by the mean value theorem, whichever says more.
Interval quotient_of_differences(const DividedDifference& u, const Interval& f_a, const Interval& f_b,
                                 const Interval& derivative) {
  return intersection(derivative, (f_b - f_a) / change(u));
}

/// f'(x) of the functions whose differences have no form of their own.
Interval derivative(Function function, const Interval& x) {
  switch (function) {
    case Function::asin:
      return Interval(1) / sqrt(Interval(1) - square(x));
    case Function::acos:
      return Interval(-1) / sqrt(Interval(1) - square(x));
    case Function::abs:
      return evaluate(Function::sign, x);
    case Function::sign:
      return x.contains(0.0) ? Interval::whole() : Interval(0);
    default:
      return Interval::whole();
  }
}

/// f(u(b)) - f(u(a)) over u(b) - u(a).
Interval slope_of(Function function, const DividedDifference& u, const Interval& f_a, const Interval& f_b) {
  switch (function) {
    case Function::sin:
      return cos(middle(u)) * sinc(half(change(u)));
    case Function::cos:
      return -(sin(middle(u)) * sinc(half(change(u))));
    case Function::tan:
      return sinc(change(u)) / (cos(u.at_a) * cos(u.at_b));
    case Function::exp:
      return evaluate(Function::exp, middle(u)) * sinhc(half(change(u)));
    case Function::sinh:
      return evaluate(Function::cosh, middle(u)) * sinhc(half(change(u)));
    case Function::cosh:
      return evaluate(Function::sinh, middle(u)) * sinhc(half(change(u)));
    case Function::tanh:
      return sinhc(change(u)) / (evaluate(Function::cosh, u.at_a) * evaluate(Function::cosh, u.at_b));
    case Function::log: {
      const Interval both = u.at_a + u.at_b;
      return Interval(2) / both * atanhc(change(u) / both);
    }
    case Function::atan: {
      const Interval below = Interval(1) + u.at_a * u.at_b;
      if (below.lower > 0) return atanc(change(u) / below) / below;
      return quotient_of_differences(u, f_a, f_b, Interval(1) / (Interval(1) + square(hull(u.at_a, u.at_b))));
    }
    case Function::asin:
    case Function::acos:
    case Function::abs:
    case Function::sign:
      return quotient_of_differences(u, f_a, f_b, derivative(function, hull(u.at_a, u.at_b)));
  }
  return Interval::whole();  // not reached: the switch is complete
}

}  // namespace

DividedDifference DividedDifference::literal(const Real& value) { return constant(Interval::literal(value)); }

DividedDifference operator+(const DividedDifference& u, const DividedDifference& v) {
  return {sum(u.at_a, v.at_a), sum(u.at_b, v.at_b), sum(u.slope, v.slope)};
}

DividedDifference operator*(const DividedDifference& u, const DividedDifference& v) {
  const Interval at_a = product(u.at_a, v.at_a);
  if (is_constant(u) && is_constant(v)) return DividedDifference::constant(at_a);
  const Interval first = is_constant(u) ? Interval(0) : product(u.slope, v.at_b);
  const Interval second = is_constant(v) ? Interval(0) : product(u.at_a, v.slope);
  return {at_a, product(u.at_b, v.at_b), sum(first, second)};
}

DividedDifference operator/(const DividedDifference& u, const DividedDifference& v) {
  const Interval at_a = u.at_a / v.at_a;
  if (is_constant(u) && is_constant(v)) return DividedDifference::constant(at_a);
  const Interval above = is_constant(v) ? u.slope : sum(u.slope, -(at_a * v.slope));
  return {at_a, u.at_b / v.at_b, above / v.at_b};
}

DividedDifference square(const DividedDifference& u) {
  if (is_constant(u)) return DividedDifference::constant(square(u.at_a));
  return {square(u.at_a), square(u.at_b), product(u.slope, u.at_a + u.at_b)};
}

DividedDifference sqrt(const DividedDifference& u) {
  const Interval at_a = sqrt(u.at_a);
  if (is_constant(u)) return DividedDifference::constant(at_a);
  const Interval at_b = sqrt(u.at_b);
  return {at_a, at_b, u.slope / (at_a + at_b)};
}

DividedDifference sin(const DividedDifference& u) { return evaluate(Function::sin, u); }
DividedDifference cos(const DividedDifference& u) { return evaluate(Function::cos, u); }

DividedDifference power(const DividedDifference& u, const DividedDifference& exponent) {
  const Interval& p = exponent.at_a;
  if (is_constant(u)) return DividedDifference::constant(power(u.at_a, p));
  constexpr double most_multiplied = 1024;
  const double n = p.lower;
  if (n == p.upper && n == std::nearbyint(n) && std::abs(n) <= most_multiplied && n != 0) {
    const DividedDifference raised = whole_power(u, static_cast<int>(std::abs(n)));
    return n > 0 ? raised : DividedDifference::literal(1) / raised;
  }
  const Interval slope = evaluate(Function::exp, exponent * evaluate(Function::log, u)).slope;
  return {power(u.at_a, p), power(u.at_b, p), slope};
}

DividedDifference evaluate(Function function, const DividedDifference& u) {
  const Interval at_a = evaluate(function, u.at_a);
  if (is_constant(u)) return DividedDifference::constant(at_a);
  const Interval at_b = evaluate(function, u.at_b);
  return {at_a, at_b, product(u.slope, slope_of(function, u, at_a, at_b))};
}

}  // namespace qdot
