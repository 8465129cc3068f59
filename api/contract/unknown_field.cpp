#include "api/contract/unknown_field.hpp"

#include <algorithm>
#include <array>
#include <optional>
#include <span>
#include <string_view>
#include <variant>

#include "api/contract/synonyms.hpp"
#include "api/contract/system_choice.hpp"
#include "api/json/suggest.hpp"

namespace qdot::api {
namespace {

std::string closest_name(std::string_view word, const std::vector<Symbol>& known) {
  std::vector<std::string> names;
  for (const Symbol& symbol : known) names.push_back(symbol.name);
  return closest(word, names);
}

/// What was meant by a name that is none of `allowed`; empty where nothing is likely.
std::string meant(const FieldSet& set, const Scene* scene, const std::string& name, Road road,
                  std::span<const std::string> allowed) {
  // "&amp;k=1" is an & of HTML.
  if (name.starts_with("amp;")) return same_letters(std::string_view(name).substr(4), allowed);
  std::string found = same_letters(with_dot_for_prime(name), allowed);
  if (const FieldInfo* field = found.empty() ? field_by_alias(set, name) : nullptr) found = field->name;
  const auto among_symbols = [&](auto search) {
    for (const FieldInfo& field : set.fields) {
      if (scene == nullptr || symbols_kind(field) == nullptr) continue;
      const std::string symbol = search(name, symbols(*scene, symbols_kind(field)->role));
      if (!symbol.empty()) return road == Road::body ? field.name + "." + symbol : symbol;
    }
    return std::string();
  };
  if (found.empty()) found = among_symbols(meant_symbol);
  if (found.empty()) found = closest(name, allowed);
  return found.empty() ? among_symbols(closest_name) : found;
}

bool has_system(const FieldSet& set) {
  return std::ranges::any_of(
      set.fields, [](const FieldInfo& field) { return std::holds_alternative<SystemKind>(field.kind); });
}

/// What is to be said of an unknown field that has the name of a symbol, or of all of them.
std::string advice_on_symbol(const FieldSet& set, const Scene& scene, const std::string& name) {
  const std::optional<SymbolRole> role = role_of(scene, name);
  const FieldInfo* home = role ? field_of(set, *role) : nullptr;
  if (home != nullptr) return " " + scene.name + " has it: it belongs in '" + home->name + "'.";
  const bool is_input = role && *role == SymbolRole::input;
  const bool is_group = name == field_name(SymbolRole::parameter) || name == field_name(SymbolRole::initial);
  if (is_group || (role && !is_input)) return " The answer is the same for all values: leave it out.";
  return names_friction(name) ? std::string(advice_on_friction) : "";
}

bool names_an_energy(std::string_view name) {
  constexpr auto energies =
      std::to_array<std::string_view>({"T", "V", "U", "kinetic", "kinetic_energy", "potential_energy"});
  return std::ranges::find(energies, name) != energies.end();
}

/// What the name of an unknown field, or what stands in it, tells of what was meant.
std::string advice_on_field(const FieldSet& set, const Scene* scene, const std::string& name,
                            const Json& value) {
  if (scene != nullptr) return advice_on_symbol(set, *scene, name);
  const bool is_scene =
      std::ranges::any_of(set.fields, [](const FieldInfo& f) { return f.name == "lagrangian"; });
  if (is_scene && names_an_energy(name)) return R"( Write the energies as one: {"lagrangian": "T - V"}.)";
  if (!has_system(set)) return {};
  if (value.is_object() && value.contains("system"))
    return " What it has inside stands by itself: {\"system\": ...}.";
  const bool is_of_a_scene = name == "coordinates" || name == "bodies" || name == "lagrangian";
  return is_of_a_scene ? " A scene stands in 'system': {\"system\": {...}}." : "";
}

}  // namespace

std::vector<std::string> field_names(const FieldSet& set, const Scene* scene, Road road) {
  std::vector<std::string> names;
  for (const FieldInfo& field : set.fields) {
    if (road == Road::body || symbols_kind(field) == nullptr) {
      names.push_back(field.name);
    } else if (scene != nullptr) {
      for (const Symbol& symbol : symbols(*scene, symbols_kind(field)->role)) names.push_back(symbol.name);
    }
  }
  return names;
}

FieldError unknown_field(const FieldSet& set, const Scene* scene, const std::string& name, const Json& value,
                         const Place& object) {
  const Place place = object.below(name);
  const std::optional<SymbolRole> role = scene == nullptr ? std::nullopt : role_of(*scene, name);
  const FieldInfo* home = role ? field_of(set, *role) : nullptr;
  std::string detail =
      "There is no field " + in_quotes(name) + "." + advice_on_field(set, scene, name, value);
  FieldError error = place.error("unknown_field", std::move(detail));
  error.allowed = field_names(set, scene, place.road());
  error.did_you_mean = meant(set, scene, name, place.road(), error.allowed);
  if (home != nullptr) error.did_you_mean = home->name + "." + name;
  return error;
}

}  // namespace qdot::api
