#include "api/contract/notes.hpp"

#include <charconv>
#include <cmath>

#include "api/contract/units.hpp"
#include "api/json/text.hpp"
#include "api/json/writer.hpp"
#include "core/numerics/constants.hpp"

namespace qdot::api {
namespace {

bool is_bare_number(const Json& given) {
  if (!given.is_string()) return given.is_number();
  const std::string_view text = trimmed(given.get_ref<const std::string&>());
  double number{};
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  return error == std::errc{} && end == text.data() + text.size();
}

std::string decimal(double value) {
  std::string text;
  append_number(text, value, 6);
  return text.ends_with(".0") ? text.substr(0, text.size() - 2) : text;
}

}  // namespace

std::string note_on(const Symbol& symbol, const Json& given, double si) {
  if (symbol.unit.find("rad") == std::string::npos) return {};
  if (symbol.unit == "rad" && std::abs(si) > 2 * pi && is_bare_number(given)) {
    const std::string number = decimal(si);
    return symbol.name + " = " + number + " is read in radians, " + decimal(si / (2 * pi)) +
           " turns; for degrees write \"" + number + "deg\".";
  }
  if (!given.is_string() || !counts_turns(given.get_ref<const std::string&>(), symbol.unit)) return {};
  return symbol.name + " = " + in_quotes(given.get_ref<const std::string&>()) +
         " counts turns: it is read as " + decimal(si) + " " + symbol.unit + ". A number alone is in " +
         symbol.unit + ".";
}

}  // namespace qdot::api
