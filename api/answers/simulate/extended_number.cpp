#include "api/answers/simulate/extended_number.hpp"

#include "core/expr/number.hpp"

namespace qdot::api {
namespace {

/// The first `count` of the digits, rounded by the others; one digit more where 999 becomes 1000.
std::string rounded_digits(const std::string& digits, std::size_t count) {
  if (digits.size() <= count) return digits;
  std::string kept = digits.substr(0, count);
  const char next = digits[count];
  const bool beyond = digits.find_first_not_of('0', count + 1) != std::string::npos;
  const bool is_odd = (kept.back() - '0') % 2 == 1;
  if (next < '5' || (next == '5' && !beyond && !is_odd)) return kept;
  std::size_t i = kept.size();
  while (i > 0 && kept[i - 1] == '9') kept[--i] = '0';
  if (i == 0) return "1" + kept;
  ++kept[i - 1];
  return kept;
}

/// 0.digits times 10^exponent, without an exponent from 1e-4 to 1e21.
std::string decimal_text(std::string digits, int exponent) {
  digits.resize(digits.find_last_not_of('0') + 1);
  const auto size = static_cast<int>(digits.size());
  if (exponent > 21 || exponent < -3) {
    const std::string fraction = size > 1 ? digits.substr(1) : "0";
    return digits.substr(0, 1) + "." + fraction + "e" + std::to_string(exponent - 1);
  }
  if (exponent <= 0) return "0." + std::string(static_cast<std::size_t>(-exponent), '0') + digits;
  if (size <= exponent) return digits + std::string(static_cast<std::size_t>(exponent - size), '0') + ".0";
  return digits.substr(0, static_cast<std::size_t>(exponent)) + "." +
         digits.substr(static_cast<std::size_t>(exponent));
}

}  // namespace

std::string extended_text(const DoubleDouble& value, int digits) {
  if (value.high == 0) return "0.0";
  const Decimal decimal = *(Number::real(value.high) + Number::real(value.low)).decimal();
  const int exponent = decimal.exponent + static_cast<int>(decimal.digits.size());
  std::string kept = rounded_digits(decimal.digits, static_cast<std::size_t>(digits));
  const auto whole = static_cast<int>(std::min(decimal.digits.size(), static_cast<std::size_t>(digits)));
  const int carried = static_cast<int>(kept.size()) - whole;
  return (value.high < 0 ? "-" : "") + decimal_text(std::move(kept), exponent + carried);
}

}  // namespace qdot::api
