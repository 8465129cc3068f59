#include <algorithm>
#include <string>

#include "core/expr/print/layout.hpp"

namespace qdot {
namespace {

constexpr std::int64_t largest_plain_denominator = 9;  // 3/4 stays a fraction at any rate
constexpr int most_decimals = 15;                      // 0.000000000000001, but 1e-16
constexpr int most_whole_digits = 16;
constexpr std::size_t most_bits_of_integers = 1000;  // beyond, no double is

/// 125 * 10^-4 as 0.0125.
std::string plain(const Decimal& decimal) {
  std::string digits = decimal.digits.empty() ? "0" : decimal.digits;
  if (decimal.exponent >= 0) return digits.append(static_cast<std::size_t>(decimal.exponent), '0');
  const auto decimals = static_cast<std::size_t>(-decimal.exponent);
  if (digits.size() <= decimals) digits.insert(0, decimals + 1 - digits.size(), '0');
  return digits.insert(digits.size() - decimals, ".");
}

/// As 1.25e-02.
std::string scientific(const Decimal& decimal) {
  std::string digits = decimal.digits;
  const int exponent = decimal.exponent + static_cast<int>(digits.size()) - 1;
  if (digits.size() > 1) digits.insert(1, ".");
  const std::string size = std::to_string(std::abs(exponent));
  return digits + (exponent < 0 ? "e-" : "e+") + (size.size() < 2 ? "0" : "") + size;
}

std::string text_of(const Decimal& decimal) {
  const int whole_digits = static_cast<int>(decimal.digits.size()) + decimal.exponent;
  if (decimal.exponent >= 0 && whole_digits > most_whole_digits) return scientific(decimal);
  if (whole_digits <= most_whole_digits && -decimal.exponent <= most_decimals) return plain(decimal);
  const int length_of_plain = std::max(whole_digits, 1) - decimal.exponent + 1;
  const std::string short_form = scientific(decimal);
  return length_of_plain > static_cast<int>(short_form.size()) ? short_form : plain(decimal);
}

}  // namespace

bool prefers_decimal(const Number& value) {
  const auto small = value.small();
  if (value.is_integer() || (small && small->denominator <= largest_plain_denominator)) return false;
  const std::optional<Decimal> decimal = value.decimal();
  if (!decimal) return false;
  const std::size_t fraction =
      integer_text(value.numerator()).size() + 1 + integer_text(value.denominator()).size();
  return text_of(*decimal).size() < fraction || value.denominator().bits() > most_bits_of_integers;
}

std::string decimal_text(const Number& value) { return text_of(value.decimal().value()); }

std::string integer_text(const Number& value) { return plain(value.decimal().value()); }

bool is_scientific(const Number& value) { return decimal_text(value).find('e') != std::string::npos; }

}  // namespace qdot
