#include "api/contract/units.hpp"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>
#include <optional>
#include <stdexcept>
#include <system_error>

#include "api/json/limits.hpp"
#include "api/json/suggest.hpp"
#include "api/json/text.hpp"
#include "core/expr/print/print.hpp"
#include "core/mechanics/unit_names.hpp"
#include "core/mechanics/units.hpp"

namespace qdot::api {
namespace {

constexpr std::string_view advice_on_ranges =
    "A range has fields of its own: t_start, t_end and samples or dt for instants, from, to and count in a sweep; "
    "a list has commas: 0,0.1,0.2.";

struct NumberAndRest {
  Number number;
  std::string_view digits;
  std::string_view rest;
};

bool begins_number(std::string_view text) {
  if (text.starts_with('-')) text.remove_prefix(1);
  if (text.starts_with('.')) text.remove_prefix(1);
  return !text.empty() && text[0] >= '0' && text[0] <= '9';  // from_chars alone would read "inf" and "nan"
}

/// expected_unit comes from a scene or a table that was checked when it was loaded.
Unit declared_unit(std::string_view expected_unit) {
  const std::optional<Unit> unit = parse_unit(expected_unit);
  if (!unit) throw std::logic_error("a symbol is declared in an unknown unit");
  return *unit;
}

/// "a number of m (km, cm, mm or um will do as well)"
std::string example(std::string_view expected_unit) {
  if (expected_unit == "1") return "a plain number such as 0.5";
  std::vector<std::string> names = unit_names_like(declared_unit(expected_unit));
  std::erase(names, expected_unit);
  const std::string also = names.empty() ? "" : " (" + enumerated(names) + " will do as well)";
  return "a number of " + std::string(expected_unit) + also;
}

/// The units that may stand behind a number.
std::vector<std::string> fitting_units(std::string_view expected_unit) {
  if (expected_unit == "1") return {};
  std::vector<std::string> names = unit_names_like(declared_unit(expected_unit));
  if (std::ranges::find(names, expected_unit) == names.end()) names.emplace(names.begin(), expected_unit);
  return names;
}

/// The only one of `names` that begins with the letter.
std::string beginning_with(char letter, const std::vector<std::string>& names) {
  const auto begins = [&](const std::string& name) { return lower_case(name).front() == letter; };
  return std::ranges::count_if(names, begins) == 1 ? *std::ranges::find_if(names, begins) : "";
}

/// The name of the unit that was meant and fits; empty where none is near.
std::string nearest_unit(std::string_view text, std::string_view expected_unit) {
  const std::vector<std::string> fitting = fitting_units(expected_unit);
  if (std::string same = same_letters(text, fitting); !same.empty()) return same;  // "m/s2"
  const bool is_word = std::ranges::all_of(text, [](unsigned char c) { return std::isalpha(c) != 0; });
  if (!is_word) return {};  // "kg*2", "d-1"
  if (text.size() == 1) return beginning_with(lower_case(text).front(), fitting);
  std::string near = closest(text, fitting);
  constexpr std::size_t too_short = 2;  // for a likeness to say much: ft is no tesla
  if (near.empty() && text.size() > too_short) near = unit_name_of(closest(text, unit_words()));
  const std::optional<Unit> unit = parse_unit(near);
  return unit && unit->dimension == declared_unit(expected_unit).dimension ? near : "";
}

bool is_whole_number(std::string_view text) {
  return !text.empty() && text.find_first_not_of("0123456789") == std::string_view::npos;
}

/// "A product is written with *: 2*pi.", and 2*pi as what was meant.
QuantityError misspelled(std::string_view sentence, const std::string& meant) {
  return {.code = "syntax",
          .detail = std::string(sentence) + ": " + printable(meant) + ".",
          .did_you_mean = printable(meant)};
}

/// Another way to write a number than ours.
std::optional<QuantityError> number_of_others(std::string_view digits, std::string_view rest) {
  const std::string before(digits);
  const std::string_view tail = rest.substr(1);
  const std::string_view exponent = trimmed(tail).starts_with('-') ? trimmed(tail).substr(1) : trimmed(tail);
  const char first = lower_case(rest).front();
  if (first == 'e' && is_whole_number(trimmed(tail)))
    return misspelled("A + of an exponent is a blank in a URL; leave it out, or write %2B",
                      before + "e" + std::string(trimmed(tail)));
  if (first == 'd' && is_whole_number(exponent))
    return misspelled("An exponent is written with e", before + "e" + std::string(trimmed(tail)));
  if (first == ',' && is_whole_number(tail)) {
    std::string whole = before;  // "1.000,5" has points between its thousands
    std::erase(whole, '.');
    return misspelled("Decimals have a point, not a comma", whole + "." + std::string(tail));
  }
  if ((first == '_' || first == '\'') && is_whole_number(tail))
    return misspelled("The digits of a number stand together", before + std::string(tail));
  if (first == 'x' && tail.starts_with("10^"))
    return misspelled("A product is written with *", before + "*" + std::string(tail));
  if (greek_by_name(rest) == "pi") return misspelled("A product is written with *", before + "*pi");
  return std::nullopt;
}

/// "grad" is a degree in some languages and a gon, a tenth less, in others.
bool is_ambiguous(std::string_view unit) { return lower_case(unit) == "grad"; }

/// What stands behind the number is no unit.
QuantityError unknown_unit(std::string_view digits, std::string_view rest, std::string_view expected_unit) {
  if (std::optional<QuantityError> error = number_of_others(digits, rest)) return *std::move(error);
  if (rest.starts_with(':')) return {.code = "syntax", .detail = std::string(advice_on_ranges)};
  if (std::string_view("*/+^").find(rest.front()) != std::string_view::npos)
    return {.code = "unknown_unit",
            .detail = "An expression has only numbers, pi and functions in it here; write " +
                      example(expected_unit) + "."};
  const std::string near = is_ambiguous(rest) ? "" : nearest_unit(rest, expected_unit);
  std::string advice = near.empty() ? " write " : " did you mean " + near + "? Write ";
  if (is_ambiguous(rest)) advice = " a degree is deg, a gradian gon;" + advice;
  QuantityError error{
      .code = "unknown_unit",
      .detail = in_quotes(rest) + " is not a unit known here;" + advice + example(expected_unit) + ".",
      .allowed = fitting_units(expected_unit)};
  if (!near.empty()) error.did_you_mean = printable(digits) + " " + near;
  return error;
}

std::variant<NumberAndRest, QuantityError> split_number(std::string_view text,
                                                        std::string_view expected_unit) {
  text = trimmed(text);
  std::string_view digits = text;
  if (digits.starts_with('+') && !digits.starts_with("+-")) digits.remove_prefix(1);
  const bool is_range = text.starts_with("linspace(") || text.find("arange(") != std::string_view::npos ||
                        text.starts_with("np.") || text.starts_with("range(");
  if (is_range) return QuantityError{"syntax", std::string(advice_on_ranges)};
  if (text.size() > limits::quantity_bytes || !begins_number(digits)) {
    return QuantityError{"syntax",
                         in_quotes(text) + " is not a quantity; write " + example(expected_unit) + "."};
  }
  double nearest{};
  const char* const end = std::from_chars(digits.data(), digits.data() + digits.size(), nearest).ptr;
  const auto length = static_cast<std::size_t>(end - digits.data());
  const std::size_t sign = digits.starts_with('-') ? 1 : 0;
  const std::optional<Number> number = Number::written(digits.substr(sign, length - sign));
  if (!number) return QuantityError{"out_of_range", in_quotes(text) + " is beyond double precision."};
  return NumberAndRest{sign == 1 ? -*number : *number, digits.substr(0, length),
                       trimmed(digits.substr(length))};
}

/// " (kg*m/s^2)" after N, nothing after m.
std::string in_base_units(std::string_view name, const Unit& unit) {
  const std::string text = to_text(unit.dimension);
  return text == name ? "" : " (" + text + ")";
}

/// How often a full turn has to be put in: "2 Hz" for a symbol in rad/s is two turns a second.
int missing_turns(const Unit& unit, const Unit& expected) {
  return unit.angle == 0 && unit.cycles == expected.angle ? unit.cycles : 0;
}

/// With the turns that are missing.
Unit counting_turns(Unit unit, const Unit& expected) {
  const int turns = missing_turns(unit, expected);
  unit.pi_power += turns;
  unit.factor = unit.factor * power(Number(2), turns);
  return unit;
}

/// An integer in digits.
std::string in_digits(const Number& integer) {
  Graph graph;
  return print(graph.number(integer), Form::text);
}

}  // namespace

std::variant<Real, QuantityError> parse_quantity(std::string_view text, std::string_view expected_unit) {
  const auto split = split_number(text, expected_unit);
  if (const auto* error = std::get_if<QuantityError>(&split)) return *error;
  const auto [number, digits, rest] = std::get<NumberAndRest>(split);
  if (rest.empty()) return number.rounded();

  const Unit expected = declared_unit(expected_unit);
  const std::optional<Unit> unit = parse_unit(rest);
  if (!unit) return unknown_unit(digits, rest, expected_unit);
  if (unit->dimension != expected.dimension) {
    return QuantityError{.code = "wrong_dimension",
                         .detail = in_quotes(rest) + in_base_units(rest, *unit) + " does not fit; " +
                                   std::string(expected_unit) + in_base_units(expected_unit, expected) +
                                   " is needed.",
                         .allowed = fitting_units(expected_unit)};
  }
  const Real value = counting_turns(*unit, expected).to_si(number);
  if (!value.is_finite()) {
    return QuantityError{"out_of_range", in_quotes(text) + " is beyond double precision."};
  }
  return value;
}

std::string exact_quantity(std::string_view text, std::string_view expected_unit) {
  const auto split = split_number(text, expected_unit);
  const auto* quantity = std::get_if<NumberAndRest>(&split);
  const std::optional<Unit> unit = quantity == nullptr ? std::nullopt : parse_unit(quantity->rest);
  if (!unit) return std::string(text);
  const Unit whole = counting_turns(*unit, declared_unit(expected_unit));
  return "(" + std::string(quantity->digits) + ")*(" + in_digits(whole.factor.numerator()) + "/" +
         in_digits(whole.factor.denominator()) + ")*pi^(" + std::to_string(whole.pi_power) + ")";
}

bool counts_turns(std::string_view text, std::string_view expected_unit) {
  if (text.find_first_of("zZ") == std::string_view::npos)
    return false;  // Hz, hertz: no other unit has cycles
  const auto split = split_number(text, expected_unit);
  const auto* quantity = std::get_if<NumberAndRest>(&split);
  if (quantity == nullptr || quantity->rest.empty()) return false;
  const std::optional<Unit> unit = parse_unit(quantity->rest);
  return unit && missing_turns(*unit, declared_unit(expected_unit)) != 0;
}

}  // namespace qdot::api
