#include "core/mechanics/unit_names.hpp"

#include <algorithm>
#include <array>
#include <utility>

namespace qdot {
namespace {

struct NamedUnit {
  std::string_view name;
  Unit unit;
};

constexpr Dimension dimension(int kg, int m, int s, int a = 0) {
  return {{Exponent{kg, 1}, Exponent{m, 1}, Exponent{s, 1}, Exponent{a, 1}}};
}

constexpr Dimension mass = dimension(1, 0, 0);
constexpr Dimension length = dimension(0, 1, 0);
constexpr Dimension duration = dimension(0, 0, 1);
constexpr Dimension frequency = dimension(0, 0, -1);
constexpr Dimension force = dimension(1, 1, -2);
constexpr Dimension energy = dimension(1, 2, -2);
constexpr Dimension rate_of_work = dimension(1, 2, -3);
constexpr Dimension pressure = dimension(1, -1, -2);
constexpr Dimension current = dimension(0, 0, 0, 1);

const auto& units() {
  static const auto table = std::to_array<NamedUnit>({
      {"1", {}},
      {"kg", {Number(1), mass}},
      {"g", {Number::ratio(1, 1000), mass}},
      {"mg", {Number::ratio(1, 1000000), mass}},
      {"km", {Number(1000), length}},
      {"m", {Number(1), length}},
      {"cm", {Number::ratio(1, 100), length}},
      {"mm", {Number::ratio(1, 1000), length}},
      {"um", {Number::ratio(1, 1000000), length}},
      {"s", {Number(1), duration}},
      {"ms", {Number::ratio(1, 1000), duration}},
      {"us", {Number::ratio(1, 1000000), duration}},
      {"min", {Number(60), duration}},
      {"h", {Number(3600), duration}},
      {"rad", {Number(1), {}, 0, 1}},
      {"deg", {Number::ratio(1, 180), {}, 1, 1}},
      {"rev", {Number(2), {}, 1, 1}},
      {"Hz", {Number(1), frequency, 0, 0, 1}},
      {"rpm", {Number::ratio(2, 60), frequency, 1, 1}},
      {"N", {Number(1), force}},
      {"kN", {Number(1000), force}},
      {"mN", {Number::ratio(1, 1000), force}},
      {"J", {Number(1), energy}},
      {"kJ", {Number(1000), energy}},
      {"mJ", {Number::ratio(1, 1000), energy}},
      {"W", {Number(1), rate_of_work}},
      {"kW", {Number(1000), rate_of_work}},
      {"Pa", {Number(1), pressure}},
      {"kPa", {Number(1000), pressure}},
      {"MPa", {Number(1000000), pressure}},
      {"A", {Number(1), current}},
      {"mA", {Number::ratio(1, 1000), current}},
      {"C", {Number(1), dimension(0, 0, 1, 1)}},
      {"V", {Number(1), dimension(1, 2, -3, -1)}},
      {"T", {Number(1), dimension(1, 0, -2, -1)}},
      {"ohm", {Number(1), dimension(1, 2, -3, -2)}},
  });
  return table;
}

/// Units of other systems and rarer multiples: they are read, and never proposed.
const auto& rarer_units() {
  static const auto table = std::to_array<NamedUnit>({
      {"in", {Number::ratio(254, 10000), length}},
      {"ft", {Number::ratio(3048, 10000), length}},
      {"yd", {Number::ratio(9144, 10000), length}},
      {"mi", {Number::ratio(1609344, 1000), length}},
      {"dm", {Number::ratio(1, 10), length}},
      {"nm", {Number::ratio(1, 1000000000), length}},
      {"lb", {Number::ratio(45359237, 100000000), mass}},
      {"lbf", {Number::ratio(44482216152605, 10000000000000), force}},
      {"dyn", {Number::ratio(1, 100000), force}},
      {"Nm", {Number(1), energy}},
      {"erg", {Number::ratio(1, 10000000), energy}},
      {"cal", {Number::ratio(4184, 1000), energy}},
      {"MJ", {Number(1000000), energy}},
      {"kWh", {Number(3600000), energy}},
      {"mW", {Number::ratio(1, 1000), rate_of_work}},
      {"mrad", {Number::ratio(1, 1000), {}, 0, 1}},
      {"gon", {Number::ratio(1, 200), {}, 1, 1}},
      {"kHz", {Number(1000), frequency, 0, 0, 1}},
  });
  return table;
}

/// A word, and the name of what it means. A plural has an s more.
constexpr auto words = std::to_array<std::pair<std::string_view, std::string_view>>({
    {"degree", "deg"},    {"radian", "rad"},    {"revolution", "rev"}, {"turn", "rev"},
    {"sec", "s"},         {"second", "s"},      {"minute", "min"},     {"hour", "h"},
    {"hr", "h"},          {"hertz", "Hz"},      {"hz", "Hz"},          {"meter", "m"},
    {"metre", "m"},       {"kilogram", "kg"},   {"Kg", "kg"},          {"gram", "g"},
    {"newton", "N"},      {"Newton", "N"},      {"joule", "J"},        {"Joule", "J"},
    {"watt", "W"},        {"Watt", "W"},        {"pascal", "Pa"},      {"Pascal", "Pa"},
    {"ampere", "A"},      {"kilometer", "km"},  {"kilometre", "km"},   {"centimeter", "cm"},
    {"centimetre", "cm"}, {"millimeter", "mm"}, {"millimetre", "mm"},  {"millisecond", "ms"},
    {"Ohm", "ohm"},       {"rads", "rad"},      {"degs", "deg"},       {"inch", "in"},
    {"inche", "in"},      {"foot", "ft"},       {"feet", "ft"},        {"yard", "yd"},
    {"mile", "mi"},       {"pound", "lb"},      {"lbs", "lb"},         {"dyne", "dyn"},
    {"calorie", "cal"},
});

constexpr auto signs = std::to_array<std::pair<std::string_view, std::string_view>>({
    {"°", "deg"},
    {"º", "deg"},  // what Spanish keyboards have
    {"˚", "deg"},
    {"²", "^2"},
    {"³", "^3"},
    {"⁻¹", "^-1"},
    {"⁻²", "^-2"},
    {"·", "*"},
    {"⋅", "*"},
    {"×", "*"},
    {"µ", "u"},
    {"μ", "u"},
    {"Ω", "ohm"},
    {"Ω", "ohm"},
});

const NamedUnit* named(std::string_view name) {
  const auto found = std::ranges::find(units(), name, &NamedUnit::name);
  if (found != units().end()) return &*found;
  const auto rarer = std::ranges::find(rarer_units(), name, &NamedUnit::name);
  return rarer == rarer_units().end() ? nullptr : &*rarer;
}

std::string_view meant_by(std::string_view word) {
  auto found = std::ranges::find(words, word, &std::pair<std::string_view, std::string_view>::first);
  if (found == words.end() && word.ends_with('s')) {
    word.remove_suffix(1);
    found = std::ranges::find(words, word, &std::pair<std::string_view, std::string_view>::first);
  }
  return found == words.end() ? std::string_view{} : found->second;
}

}  // namespace

const Unit* find_unit(std::string_view name) {
  const NamedUnit* found = named(name);
  if (found == nullptr) found = named(meant_by(name));
  return found == nullptr ? nullptr : &found->unit;
}

std::string in_ascii(std::string_view text) {
  std::string result;
  while (!text.empty()) {
    const auto sign = std::ranges::find_if(signs, [&](const auto& s) { return text.starts_with(s.first); });
    if (sign == signs.end()) {
      result += text.front();
      text.remove_prefix(1);
    } else {
      result += sign->second;
      text.remove_prefix(sign->first.size());
    }
  }
  return result;
}

std::vector<std::string> unit_words() {
  std::vector<std::string> all;
  for (const auto& [word, name] : words) all.emplace_back(word);
  return all;
}

std::string unit_name_of(std::string_view word) {
  return std::string(named(word) == nullptr ? meant_by(word) : word);
}

std::vector<std::string> unit_names_like(const Unit& unit) {
  std::vector<std::string> names;
  for (const auto& [name, other] : units()) {
    const bool speaks_of_turns = other.angle + other.cycles == unit.angle + unit.cycles;
    if (other.dimension == unit.dimension && speaks_of_turns) names.emplace_back(name);
  }
  return names;
}

}  // namespace qdot
