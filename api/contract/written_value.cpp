#include "api/contract/written_value.hpp"

#include <algorithm>
#include <cctype>

#include "api/json/suggest.hpp"
#include "api/json/text.hpp"
#include "core/expr/calculus.hpp"
#include "core/expr/parse.hpp"
#include "core/mechanics/dimension_check.hpp"
#include "core/mechanics/unit_names.hpp"

namespace qdot::api {
namespace {

using Value = std::variant<Real, QuantityError>;

/// "30 dge": after the number there is a word, and no operation.
bool looks_like_a_quantity(std::string_view text) {
  const auto first = std::ranges::find_if_not(text, [](unsigned char c) {
    return std::isdigit(c) != 0 || c == '.' || c == ' ' || c == '+' || c == '-';
  });
  const bool begins_with_number = first != text.begin();
  return begins_with_number && first != text.end() && *first != '*' && *first != '/' && *first != '^';
}

/// "2*m", "1/3": an operation follows the number.
bool begins_like_an_expression(std::string_view text) {
  const std::size_t first = text.find_first_not_of("0123456789. ");
  const bool has_number = first != 0 && first != std::string_view::npos;
  return has_number && (text[first] == '*' || text[first] == '/' || text[first] == '^');
}

bool is_unbounded(std::string_view word) {
  const std::string lower = lower_case(word);
  return lower == "inf" || lower == "infinity" || lower == "nan";
}

/// What programs write where a value is missing.
bool is_nothing(std::string_view word) {
  return word == "null" || word == "undefined" || word == "None" || word == "nil";
}

QuantityError wrong_text(const ParseError& error, const ParameterScope& scope) {
  if (error.code != ErrorCode::unknown_symbol) return {"syntax", error.message + ".", {}};
  if (find_unit(error.symbol) != nullptr) {
    return {
        "unknown_symbol",
        "An expression has no units: " + in_quotes(error.symbol) +
            " is none of the parameters. A quantity is a number with its unit behind it, such as '30 deg'.",
        scope.names()};
  }
  if (is_nothing(error.symbol))
    return {.code = "wrong_type", .detail = in_quotes(error.symbol) + " is no value: leave the field out."};
  if (is_unbounded(error.symbol))
    return {.code = "out_of_range", .detail = in_quotes(error.symbol) + " is no finite number."};
  return {.code = "unknown_symbol",
          .detail = error.message + ".",
          .allowed = scope.names(),
          .did_you_mean = closest(error.symbol, scope.names())};
}

struct Spoken {
  std::vector<RealAssignment> values;
  SymbolDimensions dimensions;
};

/// The parameters that e speaks of.
std::variant<Spoken, QuantityError> parameters_in(const Expression& e, ParameterScope& scope) {
  Spoken spoken;
  for (std::size_t i = 0; i < scope.names().size(); ++i) {
    const Expression symbol = e.graph().symbol(scope.names()[i]);
    if (!depends_on(e, symbol)) continue;
    const Value value = scope.value_of(i);
    if (const auto* error = std::get_if<QuantityError>(&value)) return *error;
    spoken.values.emplace_back(symbol, std::get<Real>(value));
    spoken.dimensions[symbol.id()] = parse_unit(scope.parameter(i).unit).value_or(Unit{}).dimension;
  }
  return spoken;
}

/// A number alone is in SI; what speaks of parameters has a dimension.
std::optional<QuantityError> misfit(const Expression& e, const SymbolDimensions& symbols,
                                    std::string_view expected_unit) {
  if (symbols.empty()) return std::nullopt;
  const DimensionResult found = dimension_of(e, symbols);
  if (!found.mistake.empty())
    return QuantityError{"wrong_dimension", "It does not fit: " + found.mistake + ".", {}};
  const Dimension needed = parse_unit(expected_unit).value_or(Unit{}).dimension;
  if (!found.dimension || *found.dimension == needed) return std::nullopt;
  return QuantityError{
      "wrong_dimension",
      "Its value is in " + to_text(*found.dimension) + "; " + std::string(expected_unit) + " is needed.",
      {}};
}

Value expression_value(std::string_view text, std::string_view expected_unit, ParameterScope& scope) {
  Graph graph;
  const std::string plain = in_ascii(greek_by_name(text));
  const ParseResult parsed = parse_all(plain, graph, scope.names());
  if (!parsed.errors.empty()) return wrong_text(parsed.errors.front(), scope);
  const Expression& e = *parsed.expression;
  const auto spoken = parameters_in(e, scope);
  if (const auto* error = std::get_if<QuantityError>(&spoken)) return *error;
  const auto& [values, dimensions] = std::get<Spoken>(spoken);
  if (std::optional<QuantityError> error = misfit(e, dimensions, expected_unit)) return *std::move(error);
  const Real value = evaluate_exactly(e, values);
  if (!value.is_finite()) return QuantityError{"out_of_range", in_quotes(text) + " has no finite value.", {}};
  return value;
}

/// The parameters that `letters` is made of, the longest first, with * between: "mg" is m*g. Empty: of none.
std::string product_of_names(std::string_view letters, const std::vector<std::string>& names) {
  std::string product;
  while (!letters.empty()) {
    std::string_view longest;
    for (const std::string& name : names) {
      if (letters.starts_with(name) && name.size() > longest.size()) longest = name;
    }
    if (longest.empty()) return {};
    product += (product.empty() ? "" : "*") + std::string(longest);
    letters.remove_prefix(longest.size());
  }
  return product;
}

/// "2mg/l" as "2*m*g/l"; empty where something in it is no parameter.
std::string with_products(std::string_view text, const std::vector<std::string>& names) {
  std::string result;
  const auto is_letter = [](unsigned char c) { return std::isalpha(c) != 0 || c == '_'; };
  while (!text.empty()) {
    const auto end = std::ranges::find_if_not(text, is_letter);
    const std::string_view letters = text.substr(0, static_cast<std::size_t>(end - text.begin()));
    if (letters.empty()) {
      if (text.front() != ' ') result += text.front();
      text.remove_prefix(1);
      continue;
    }
    const std::string product = product_of_names(letters, names);
    if (product.empty()) return {};
    const bool follows_factor =
        !result.empty() &&
        (std::isdigit(static_cast<unsigned char>(result.back())) != 0 || result.back() == ')');
    result += (follows_factor ? "*" : "") + product;
    text.remove_prefix(letters.size());
  }
  return result;
}

/// "pi/6 rad" without its unit; empty where that is not the one expected.
std::string_view without_unit(std::string_view text, std::string_view expected_unit) {
  text = trimmed(text);
  if (!text.ends_with(expected_unit)) return {};
  text.remove_suffix(expected_unit.size());
  text = trimmed(text);
  if (text.ends_with('*')) text.remove_suffix(1);
  return trimmed(text);
}

}  // namespace

ParameterScope::ParameterScope(const Scene& scene, const Json& given, const Place& place)
    : scene_(&scene),
      given_(&given),
      place_(&place),
      is_open_(scene.parameters.size()),
      varies_(scene.parameters.size()) {
  for (const Parameter& parameter : scene.parameters) names_.push_back(parameter.name);
}

void ParameterScope::leave_open(const std::string& name) {
  const auto found = std::ranges::find(names_, name);
  if (found != names_.end()) varies_[static_cast<std::size_t>(found - names_.begin())] = true;
}

std::variant<Real, QuantityError> ParameterScope::value_of(std::size_t i) {
  if (varies_[i])
    return QuantityError{
        "varies", "It speaks of " + in_quotes(names_[i]) + ", which has many values in this sweep.", {}};
  if (is_open_[i]) {
    return QuantityError{"circular", "The value of " + in_quotes(names_[i]) + " depends on itself.", {}};
  }
  is_open_[i] = true;
  Value value = read(i);
  is_open_[i] = false;
  return value;
}

std::variant<Real, QuantityError> ParameterScope::read(std::size_t i) {
  const Parameter& parameter = scene_->parameters[i];
  const auto found = given_->is_object() ? given_->find(parameter.name) : given_->end();
  if (found == given_->end()) return written_value(parameter.default_value, parameter.unit, *this);
  if (found->is_number()) {
    return written_value(place_->below(parameter.name).written(*found), parameter.unit, *this);
  }
  if (found->is_string()) return written_value(found->get_ref<const std::string&>(), parameter.unit, *this);
  return QuantityError{"wrong_type", "It needs " + in_quotes(parameter.name) + ", which is no number.", {}};
}

std::variant<Real, QuantityError> written_value(std::string_view text, std::string_view expected_unit,
                                                ParameterScope& scope) {
  // What is plainly an expression is not first looked up among the units.
  if (begins_like_an_expression(text)) {
    if (Value value = expression_value(text, expected_unit, scope); std::holds_alternative<Real>(value))
      return value;
  }
  Value quantity = parse_quantity(text, expected_unit);
  const auto* error = std::get_if<QuantityError>(&quantity);
  if (error == nullptr || (error->code != "syntax" && error->code != "unknown_unit")) return quantity;
  Value value = expression_value(text, expected_unit, scope);
  const auto* other = std::get_if<QuantityError>(&value);
  const bool has_unknown_unit = error->code == "unknown_unit" && error->did_you_mean.empty();
  if (other != nullptr && has_unknown_unit) {
    if (std::string meant = with_products(text, scope.names());
        !meant.empty() && std::holds_alternative<Real>(expression_value(meant, expected_unit, scope))) {
      return QuantityError{.code = "syntax",
                           .detail = "A product is written with *: " + printable(meant) + ".",
                           .did_you_mean = printable(meant)};
    }
  }
  const std::string_view bare = other != nullptr ? without_unit(text, expected_unit) : std::string_view();
  if (!bare.empty() && std::holds_alternative<Real>(expression_value(bare, expected_unit, scope))) {
    return QuantityError{.code = other->code,
                         .detail = "An expression has no unit behind it, and is in " +
                                   std::string(expected_unit) + ": " + printable(bare) + ".",
                         .did_you_mean = printable(bare)};
  }
  const bool is_no_expression = other != nullptr && (other->code == "syntax" || scope.names().empty());
  return is_no_expression && (looks_like_a_quantity(text) || scope.names().empty()) ? quantity : value;
}

}  // namespace qdot::api
