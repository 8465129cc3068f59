#include "core/mechanics/units.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <numeric>

#include "core/base/error.hpp"
#include "core/mechanics/unit_names.hpp"

namespace qdot {
namespace {

/// Held to what can mean anything, so that ((rad^99)^99)^99 does not overflow.
constexpr int bounded(int count) { return std::clamp(count, -100, 100); }

Unit product(const Unit& a, const Unit& b) {
  return {a.factor * b.factor, a.dimension * b.dimension, bounded(a.pi_power + b.pi_power),
          bounded(a.angle + b.angle), bounded(a.cycles + b.cycles)};
}

Unit inverse(const Unit& a) {
  return {Number(1) / a.factor, Dimension{} / a.dimension, -a.pi_power, -a.angle, -a.cycles};
}

/// A fractional power keeps numbers exact only where there is nothing to convert: no value for cm^(1/2).
std::optional<Unit> raised(const Unit& unit, Exponent exponent) {
  if (exponent.denominator != 1) {
    if (!unit.is_coherent() || unit.angle != 0 || unit.cycles != 0) return std::nullopt;
    return Unit{Number(1), pow(unit.dimension, exponent.numerator, exponent.denominator)};
  }
  const Unit step = exponent.numerator < 0 ? inverse(unit) : unit;
  Unit result;
  for (int i = 0; i < std::abs(exponent.numerator); ++i) result = product(result, step);
  return result;
}

/// Recursive descent; the length of the text (80 bytes) bounds the recursion.
///   unit  := [ "/" ] power { ("*" | "/" | " ") power }
///   power := atom [ ("^" | "**") exponent ]
///   atom  := name | "1" | "(" unit ")"          exponent := integer | "(" integer [ "/" integer ] ")"
class UnitParser {
 public:
  explicit UnitParser(std::string_view text) : text_(text) {}

  std::optional<Unit> parse() {
    const std::optional<Unit> result = unit();
    skip_spaces();
    return position_ == text_.size() ? result : std::nullopt;
  }

 private:
  void skip_spaces() {
    while (position_ < text_.size() && text_[position_] == ' ') ++position_;
  }

  bool take(std::string_view token) {
    skip_spaces();
    if (!text_.substr(position_).starts_with(token)) return false;
    position_ += token.size();
    return true;
  }

  /// "N m": a blank before a name.
  [[nodiscard]] bool at_apart_name() const {
    const bool is_apart = position_ > 0 && position_ < text_.size() && text_[position_ - 1] == ' ';
    return is_apart && is_letter(text_[position_]);
  }

  static bool is_letter(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z'); }

  std::optional<Unit> unit() {
    std::optional<Unit> left = take("/") ? inverse_of_power() : power_of_atom();
    while (left) {
      const bool divides = take("/");
      if (!divides && !take("*") && !at_apart_name()) break;
      const std::optional<Unit> right = power_of_atom();
      if (!right) return std::nullopt;
      left = product(*left, divides ? inverse(*right) : *right);
    }
    return left;
  }

  std::optional<Unit> inverse_of_power() {
    const std::optional<Unit> below = power_of_atom();
    return below ? std::optional(inverse(*below)) : std::nullopt;
  }

  std::optional<Unit> power_of_atom() {
    const std::optional<Unit> base = atom();
    if (!base || !(take("**") || take("^"))) return base;
    const std::optional<Exponent> power = exponent();
    return power ? raised(*base, *power) : std::nullopt;
  }

  std::optional<Unit> atom() {
    if (take("(")) {
      const std::optional<Unit> inner = unit();
      return inner && take(")") ? inner : std::nullopt;
    }
    if (take("1")) return Unit{};
    return named();
  }

  std::optional<Unit> named() {
    skip_spaces();
    const std::string_view rest = text_.substr(position_);
    const auto end = std::ranges::find_if_not(rest, is_letter);
    const std::string_view name = rest.substr(0, static_cast<std::size_t>(end - rest.begin()));
    const Unit* const found = find_unit(name);
    if (found == nullptr) return std::nullopt;
    position_ += name.size();
    return *found;
  }

  std::optional<Exponent> exponent() {
    if (!take("(")) {
      const std::optional<int> whole = integer();
      return whole ? std::optional(Exponent{*whole, 1}) : std::nullopt;
    }
    const std::optional<int> numerator = integer();
    const std::optional<int> denominator = take("/") ? integer() : 1;
    if (!numerator || !denominator || *denominator == 0 || !take(")")) return std::nullopt;
    return reduced(*numerator, *denominator);
  }

  /// At most two digits: no unit has a larger exponent.
  std::optional<int> integer() {
    const bool negative = take("-");
    skip_spaces();
    int value = 0;
    std::size_t digits = 0;
    for (; position_ < text_.size() && text_[position_] >= '0' && text_[position_] <= '9'; ++position_) {
      if (++digits > 2) return std::nullopt;
      value = 10 * value + (text_[position_] - '0');
    }
    if (digits == 0) return std::nullopt;
    return negative ? -value : value;
  }

  std::string_view text_;
  std::size_t position_{0};
};

std::optional<Unit> parsed(std::string_view text) {
  try {
    return UnitParser(text).parse();
  } catch (const Error&) {
    return std::nullopt;  // (um^99)^99 has too many digits
  }
}

}  // namespace

std::optional<Unit> parse_unit(std::string_view text) {
  constexpr std::size_t longest = 80;
  if (text.size() > longest) return std::nullopt;
  const std::optional<Unit> unit = parsed(in_ascii(text));
  // um^99 is beyond double precision.
  if (!unit || !std::isfinite(unit->factor.value()) || unit->factor.value() == 0) return std::nullopt;
  return unit;
}

}  // namespace qdot
