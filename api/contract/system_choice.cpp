#include "api/contract/system_choice.hpp"

#include <algorithm>

#include "api/contract/notes.hpp"
#include "api/contract/synonyms.hpp"
#include "api/json/limits.hpp"
#include "api/json/suggest.hpp"
#include "api/json/text.hpp"

namespace qdot::api {
namespace {

constexpr SymbolRole roles[] = {SymbolRole::parameter, SymbolRole::initial, SymbolRole::input};

std::string per_second(const std::string& unit) {
  return (unit.find('/') == std::string::npos ? unit : "(" + unit + ")") + "/s";
}

/// "a parameter", for sentences.
std::string kind_name(SymbolRole role) {
  switch (role) {
    case SymbolRole::parameter:
      return "parameter";
    case SymbolRole::initial:
      return "coordinate or velocity";
    case SymbolRole::input:
      return "input";
    case SymbolRole::equilibrium:
    case SymbolRole::position:
      return "coordinate";
  }
  return {};
}

/// "spring_pendulum has no parameter 'kk'.", and where the name belongs when it is another kind of symbol.
FieldError unknown_symbol(const Scene& scene, SymbolRole role, const std::string& name, const Place& place,
                          std::vector<std::string> allowed) {
  const std::string detail = (scene.name.empty() ? "The system" : scene.name) + " has no " + kind_name(role) +
                             " " + in_quotes(name) + ".";
  const std::optional<SymbolRole> other = role_of(scene, name);
  if (!other) {
    const std::string plain = with_dot_for_prime(name);
    FieldError error = unknown_name(place, detail, plain, std::move(allowed));
    const std::string meant = meant_symbol(plain, symbols(scene, role));
    const bool is_exact = !same_letters(plain, error.allowed).empty();
    if (names_friction(name)) error.detail += advice_on_friction;
    if (!meant.empty() && !is_exact) error.did_you_mean = meant;
    return error;
  }
  FieldError error = place.error("unknown_field", detail + " It belongs in '" + field_name(*other) + "'.");
  error.did_you_mean = field_name(*other) + "." + name;
  return error;
}

/// An input is an expression; a number is one too.
std::optional<Json> read_input(const Symbol& symbol, const Json& value, const Place& place, Errors& errors) {
  if (value.is_number()) return place.written(value);
  return read_value(TextKind{.most_bytes = limits::expression_bytes}, symbol.name, value, place, errors);
}

std::vector<std::pair<std::string, Real>>& numbers_of(SymbolRole role, SystemChoice& choice) {
  switch (role) {
    case SymbolRole::parameter:
      return choice.parameters;
    case SymbolRole::equilibrium:
      return choice.equilibrium;
    case SymbolRole::position:
      return choice.position;
    case SymbolRole::initial:
    case SymbolRole::input:  // has no numbers
      break;
  }
  return choice.initial;
}

/// The resolved value, which `choice` has taken.
std::optional<Json> read_symbol(SymbolRole role, const Symbol& symbol, const Json& value, const Place& place,
                                ParameterScope& scope, SystemChoice& choice, Errors& errors) {
  if (role == SymbolRole::input) {
    std::optional<Json> text = read_input(symbol, value, place, errors);
    if (text) choice.inputs.emplace_back(symbol.name, text->get<std::string>());
    return text;
  }
  const auto number = read_number({symbol.unit, symbol.domain}, symbol.name, value, place, scope, errors);
  if (!number) return std::nullopt;
  if (std::string note = note_on(symbol, value, number->value); !note.empty())
    choice.notes.push_back(std::move(note));
  numbers_of(role, choice).emplace_back(symbol.name, *number);
  if (role == SymbolRole::parameter || role == SymbolRole::initial)
    choice.written.emplace_back(symbol.name,
                                value.is_string() ? value.get<std::string>() : place.written(value));
  return number->value;
}

}  // namespace

std::vector<Symbol> symbols(const Scene& scene, SymbolRole role) {
  std::vector<Symbol> result;
  switch (role) {
    case SymbolRole::parameter:
      for (const Parameter& p : scene.parameters) result.push_back({p.name, p.unit, p.domain, p.meaning});
      break;
    case SymbolRole::initial:
      for (const Coordinate& q : scene.coordinates) result.push_back({q.name, q.unit, q.domain, q.meaning});
      for (const Coordinate& q : scene.coordinates)
        result.push_back({q.name + "_dot", scene.without_units ? "1" : per_second(q.unit), {}});
      break;
    case SymbolRole::input:
      for (const Input& input : scene.inputs) result.push_back({input.name, input.unit, {}, input.meaning});
      break;
    case SymbolRole::equilibrium:
    case SymbolRole::position:
      for (const Coordinate& q : scene.coordinates) result.push_back({q.name, q.unit, q.domain, q.meaning});
      break;
  }
  return result;
}

std::optional<SymbolRole> role_of(const Scene& scene, const std::string& name) {
  for (const SymbolRole role : roles) {
    const std::vector<Symbol> known = symbols(scene, role);
    if (std::ranges::find(known, name, &Symbol::name) != known.end()) return role;
  }
  return std::nullopt;
}

Json read_symbols(SymbolRole role, const Json& value, const Place& place, ParameterScope& scope,
                  SystemChoice& choice, Errors& errors) {
  Json resolved = Json::object();
  if (!value.is_object()) {
    errors.push_back(
        place.error("wrong_type", "'" + field_name(role) + "' needs an object, {\"name\": value}."));
    return resolved;
  }
  const std::vector<Symbol> known = symbols(*choice.scene, role);
  std::vector<std::string> names;
  for (const Symbol& symbol : known) names.push_back(symbol.name);
  for (const auto& [name, given] : value.items()) {
    if (is_full(errors)) break;
    if (std::ranges::find(names, name) != names.end()) continue;
    errors.push_back(unknown_symbol(*choice.scene, role, name, place.below(name), names));
  }
  for (const Symbol& symbol : known) {
    const auto given = value.find(symbol.name);
    if (given == value.end()) continue;
    const Place here = place.below(symbol.name);
    std::optional<Json> read = read_symbol(role, symbol, *given, here, scope, choice, errors);
    if (read) resolved[symbol.name] = std::move(*read);
  }
  return resolved;
}

}  // namespace qdot::api
