#include "api/answers/stated.hpp"

#include <charconv>
#include <cmath>
#include <string>

#include "core/numerics/constants.hpp"

namespace qdot::api {
namespace {

/// A double that is a decimal of few digits, too.
bool is_short_decimal(double x) {
  const double scaled = x * 0x1p10;
  return std::abs(x) < 0x1p23 && scaled == std::trunc(scaled);
}

/// How far the decimal that is written is from the value: 0.1 is not the double that it names.
double rounded_away(double value, int digits) {
  const double written = digits == shortest_digits ? value : rounded(value, digits);
  std::string text;
  append_number(text, written);
  long double decimal{};
  std::from_chars(text.data(), text.data() + text.size(), decimal);
  const long double off = std::abs(decimal - static_cast<long double>(value));
  if (off == 0 && is_short_decimal(value)) return 0;
  // With fewer digits, also from the decimal that names the double.
  const double other_reading = std::abs(value) * (written == value ? 0x1p-62 : 0x1p-52);
  return static_cast<double>(off) * (1 + 0x1p-50) + other_reading;
}

}  // namespace

Stated Stated::within(double value, const Interval& enclosure) {
  return {value, (enclosure - Interval(value)).magnitude()};
}

Interval enclosed_pi() { return {pi, std::nextafter(pi, infinity)}; }

Interval Stated::enclosure() const { return Interval(value) + Interval(-error, error); }

Stated Stated::as_typed(const Real& typed) const {
  if (error != 0 || value != typed.value) return *this;
  return {value, (Interval(std::abs(typed.low)) + Interval(typed.error)).upper};
}

Json stated_error(const Stated& number, int digits) {
  if (!std::isfinite(number.error)) return nullptr;
  const double lost = rounded_away(number.value, digits);
  return stated_bound(lost == 0 ? number.error : (Interval(number.error) + Interval(lost)).upper, digits);
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
