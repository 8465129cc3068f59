#include "api/about/field_help.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <string_view>
#include <variant>

#include "api/contract/system_choice.hpp"
#include "api/json/documents.hpp"

namespace qdot::api {
namespace {

constexpr std::size_t longest_line = 100;
constexpr std::size_t margin = 18;  // where the text beside a name begins

std::string written(double value) {
  char buffer[32];
  std::snprintf(buffer, sizeof buffer, "%g", value);
  return buffer;
}

/// " > 0", " from 0 to 1"
std::string bounds(const Domain& domain) {
  const bool has_lower = std::isfinite(domain.lower), has_upper = std::isfinite(domain.upper);
  if (has_lower && has_upper && !domain.lower_open && !domain.upper_open)
    return " from " + written(domain.lower) + " to " + written(domain.upper);
  std::string text;
  if (has_lower) text += (domain.lower_open ? " > " : " >= ") + written(domain.lower);
  if (has_lower && has_upper) text += " and";
  if (has_upper) text += (domain.upper_open ? " < " : " <= ") + written(domain.upper);
  return text;
}

std::string joined(const std::vector<std::string>& words) {
  std::string text;
  for (const std::string& word : words) text += (text.empty() ? "" : ", ") + word;
  return text;
}

std::string in_words(const Kind& kind);

/// What a field takes: "number in s > 0".
struct InWords {
  std::string operator()(const NumberKind& kind) const {
    return "number" + (kind.unit == "1" ? "" : " in " + kind.unit) + bounds(kind.range);
  }
  std::string operator()(const IntegerKind& kind) const {
    return "integer from " + std::to_string(kind.least) + " to " + std::to_string(kind.most);
  }
  std::string operator()(const BooleanKind&) const { return "true or false"; }
  std::string operator()(const TextKind&) const { return "text"; }
  std::string operator()(const ChoiceKind& kind) const { return "one of " + joined(kind.options); }
  std::string operator()(const ListKind& kind) const {
    return "with commas between, each " + in_words(*kind.element);
  }
  std::string operator()(const SystemKind&) const { return "name"; }
  std::string operator()(const SymbolsKind& kind) const {
    const bool needs_prefix = kind.role == SymbolRole::equilibrium || kind.role == SymbolRole::position;
    return needs_prefix ? "each as " + std::string(field_name(kind.role)) + ".name=value"
                        : "each as name=value";
  }
  std::string operator()(const ParameterValueKind& kind) const {
    return "number in the unit of '" + kind.parameter + "'";
  }
  /// A scene's kinds: no request on a command line has them.
  template <class Other>
  std::string operator()(const Other&) const {
    return "value";
  }
};

std::string in_words(const Kind& kind) {
  const KindVariant& variant = kind;
  return std::visit(InWords{}, variant);
}

std::string defaults(const FieldInfo& field) {
  if (field.need == Need::required) return "; required";
  const Json& value = field.default_value;
  if (value.is_null() || (value.is_structured() && value.empty())) return "";
  if (!value.is_array())
    return "; default " + (value.is_string() ? value.get<std::string>() : dump_json(value));
  return "; default " + joined(value.get<std::vector<std::string>>());
}

/// Breaks `text` at blanks, so that it fits beside the names.
std::string beside_name(std::string_view text) {
  std::string lines;
  while (text.size() > longest_line - margin) {
    const std::size_t end = text.rfind(' ', longest_line - margin);
    lines += std::string(text.substr(0, end)) + "\n" + std::string(margin, ' ');
    text.remove_prefix(end + 1);
  }
  return lines + std::string(text);
}

std::string in_words(const FieldInfo& field) {
  std::string name = "  " + field.name;
  name.resize(std::max(margin, name.size() + 1), ' ');
  return name + beside_name(field.description + " (" + in_words(field.kind) + defaults(field) + ")");
}

}  // namespace

std::string symbols_as_text(const Scene& scene) {
  std::string text = "Symbols of " + scene.name + ":";
  const auto add = [&](const std::string& name, const std::string& unit, const std::string& by_default,
                       const std::string& meaning) {
    std::string start = "  " + name;
    start.resize(std::max(margin, start.size() + 1), ' ');
    const std::string what = (unit == "1" ? "" : "in " + unit + "; ") + "default " + by_default;
    text += "\n" + start + beside_name(meaning + (meaning.empty() ? "(" : " (") + what + ")");
  };
  for (const Parameter& p : scene.parameters) add(p.name, p.unit, p.default_value, p.meaning);
  for (const Coordinate& q : scene.coordinates) add(q.name, q.unit, q.initial, q.meaning);
  const std::vector<Symbol> states = symbols(scene, SymbolRole::initial);
  for (std::size_t i = 0; i < scene.coordinates.size(); ++i) {
    const Symbol& velocity = states[scene.coordinates.size() + i];
    const Coordinate& q = scene.coordinates[i];
    add(velocity.name, velocity.unit, q.initial_rate, "velocity of " + q.name);
  }
  for (const Input& input : scene.inputs) add(input.name, input.unit, input.default_value, input.meaning);
  return text;
}

std::string fields_as_text(const FieldSet& set) {
  std::string text = "Fields (a value may carry its unit, \"30deg\"):";
  for (const FieldInfo& field : set.fields) text += "\n" + in_words(field);
  return text;
}

}  // namespace qdot::api
