#include "core/expr/decimal.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>

namespace qdot {
namespace {

std::size_t past_digits(std::string_view text, std::size_t at) {
  while (at < text.size() && text[at] >= '0' && text[at] <= '9') ++at;
  return at;
}

}  // namespace

std::optional<Decimal> take_apart(std::string_view text) {
  const std::size_t point = past_digits(text, 0);
  const bool has_point = point < text.size() && text[point] == '.';
  const std::size_t end = has_point ? past_digits(text, point + 1) : point;
  Decimal result;
  result.digits = text.substr(0, point);
  if (has_point) result.digits += text.substr(point + 1, end - point - 1);
  if (result.digits.empty()) return std::nullopt;
  result.exponent = has_point ? -static_cast<int>(end - point - 1) : 0;
  result.digits.erase(0, std::min(result.digits.find_first_not_of('0'), result.digits.size()));
  if (end == text.size()) return result;
  if (text[end] != 'e' && text[end] != 'E') return std::nullopt;
  const std::size_t sign = end + 1 < text.size() && text[end + 1] == '+' ? 1 : 0;
  int exponent = 0;
  const char* const last = text.data() + text.size();
  const auto [stop, error] = std::from_chars(text.data() + end + 1 + sign, last, exponent);
  if (error != std::errc{} || stop != last || std::abs(exponent) > 100'000) return std::nullopt;
  result.exponent += exponent;
  return result;
}

}  // namespace qdot
