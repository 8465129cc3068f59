#include "api/answers/stated.hpp"

#include <algorithm>
#include <cmath>

#include "core/numerics/constants.hpp"

namespace qdot::api {
namespace {

/// How far the decimal that is written may be from the value.
Interval rounded_away(double value, int digits) {
  const double written = rounded(value, digits);
  if (written == value) return 0;
  const double half_unit = (std::nextafter(std::abs(written), infinity) - std::abs(written)) / 2;
  return Interval((Interval(written) - Interval(value)).magnitude()) + Interval(half_unit);
}

}  // namespace

Stated Stated::within(double value, const Interval& enclosure) {
  return {value, (enclosure - Interval(value)).magnitude()};
}

Interval enclosed_pi() { return {pi, std::nextafter(pi, infinity)}; }

Interval Stated::enclosure() const { return Interval(value) + Interval(-error, error); }

Json stated_error(const Stated& number, int digits) {
  if (!std::isfinite(number.error)) return nullptr;
  const Interval lost = rounded_away(number.value, digits);
  return stated_bound(is_zero(lost) ? number.error : (Interval(number.error) + lost).upper, digits);
}

Json stated_error(const std::complex<double>& value, double error, int digits) {
  if (!std::isfinite(error)) return nullptr;
  const Interval re = rounded_away(value.real(), digits), im = rounded_away(value.imag(), digits);
  const Interval lost = sqrt(square(re) + square(im));
  return stated_bound(is_zero(lost) ? error : (Interval(error) + lost).upper, digits);
}

Json stated_bound(double bound, int digits) {
  if (!std::isfinite(bound)) return nullptr;
  if (digits == shortest_digits || bound == 0) return bound;
  const double written = rounded_up(std::nextafter(bound, infinity), digits);
  return std::isfinite(written) ? Json(written) : Json(nullptr);
}

}  // namespace qdot::api
