#include <charconv>
#include <string>

#include "core/expr/print/layout.hpp"

namespace qdot {
namespace {

constexpr std::int64_t largest_plain_denominator = 9;  // 3/4 stays a fraction at any rate
constexpr int most_decimals = 15;

/// p/q with q a divisor of 10^decimals, or an empty text.
std::string exact_decimal(const Number& value) {
  __int128 p = value.numerator();
  int decimals = 0;
  while (p % value.denominator() != 0) {
    p *= 10;
    if (++decimals > most_decimals) return "";
  }
  p /= value.denominator();
  if (p > std::int64_t{1} << 53) return "";
  std::string digits = std::to_string(static_cast<std::int64_t>(p));
  if (decimals == 0) return digits;
  if (static_cast<int>(digits.size()) <= decimals) digits.insert(0, decimals + 1 - digits.size(), '0');
  return digits.insert(digits.size() - decimals, ".");
}

}  // namespace

bool prefers_decimal(const Number& value) {
  if (!value.is_exact()) return true;
  if (value.denominator() <= largest_plain_denominator) return false;
  const std::string decimal = exact_decimal(value);
  const std::size_t fraction =
      std::to_string(value.numerator()).size() + 1 + std::to_string(value.denominator()).size();
  return !decimal.empty() && decimal.size() < fraction;
}

std::string decimal_text(const Number& value) {
  if (value.is_exact()) return exact_decimal(value);
  char buffer[64];
  char* const end = buffer + sizeof buffer;
  const std::string text(buffer, std::to_chars(buffer, end, value.value()).ptr);
  if (text.find_first_of(".en") != std::string::npos) return text;
  return {buffer, std::to_chars(buffer, end, value.value(), std::chars_format::scientific).ptr};
}

}  // namespace qdot
