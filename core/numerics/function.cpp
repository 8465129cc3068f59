#include "core/numerics/function.hpp"

#include <sleef.h>

#include <cmath>

namespace qdot {

double evaluate(Function function, double x) {
  switch (function) {
    case Function::sin:
      return Sleef_cinz_sind1_u10purec(x);
    case Function::cos:
      return Sleef_cinz_cosd1_u10purec(x);
    case Function::tan:
      return Sleef_cinz_tand1_u10purec(x);
    case Function::asin:
      return Sleef_cinz_asind1_u10purec(x);
    case Function::acos:
      return Sleef_cinz_acosd1_u10purec(x);
    case Function::atan:
      return Sleef_cinz_atand1_u10purec(x);
    case Function::sinh:
      return Sleef_cinz_sinhd1_u10purec(x);
    case Function::cosh:
      return Sleef_cinz_coshd1_u10purec(x);
    case Function::tanh:
      return Sleef_cinz_tanhd1_u10purec(x);
    case Function::exp:
      return Sleef_cinz_expd1_u10purec(x);
    case Function::log:
      return Sleef_cinz_logd1_u10purec(x);
    case Function::abs:
      return std::abs(x);
    case Function::sign:
      return std::isnan(x) ? x : static_cast<double>((x > 0) - (x < 0));
  }
  return x;  // not reached: the switch is complete
}

namespace {

double whole_power(double base, int exponent) {
  if (exponent == 1) return base;
  const double half = whole_power(base, exponent / 2);
  return exponent % 2 == 1 ? half * half * base : half * half;
}

}  // namespace

double power(double base, double exponent) {
  constexpr double most_multiplied = 1024;
  const double twice = 2 * exponent;
  const bool by_products = twice == std::nearbyint(twice) && std::abs(twice) <= most_multiplied && twice != 0;
  if (!by_products) return Sleef_cinz_powd1_u10purec(base, exponent);
  const bool halves = exponent != std::nearbyint(exponent);
  const int size = static_cast<int>(std::abs(halves ? twice : exponent));
  const double result = whole_power(halves ? std::sqrt(base) : base, size);
  return exponent < 0 ? 1 / result : result;
}

}  // namespace qdot
