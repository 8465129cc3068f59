#include "api/contract/json_schema.hpp"

#include <cmath>

#include "api/contract/document_schema.hpp"
#include "api/json/documents.hpp"
#include "api/json/limits.hpp"

namespace qdot::api {
namespace {

/// Which form of a field is described.
enum class SchemaFor { body, query, echo };

/// Of a body, defaults are said in words: clients that are generated take a field with a `default` for one
/// that is always there.
Json described(Json schema, const FieldInfo& field, SchemaFor form) {
  schema["description"] = field.description;
  const Json& value = field.default_value;
  const bool is_said = !value.is_null() && !(value.is_structured() && value.empty());
  if (form == SchemaFor::body && is_said)
    schema["description"] = field.description + " (default " + dump_json(value) + ")";
  if (form == SchemaFor::query && !value.is_null()) schema["default"] = value;
  if (!field.aliases.empty()) schema["x-aliases"] = field.aliases;
  return schema;
}

/// A number, or except in an echo a text with its unit.
Json number_schema(const std::string& unit, const Domain& range, SchemaFor form) {
  Json number{{"type", "number"}};
  number.update(domain_json(range));
  Json schema = number;
  if (form != SchemaFor::echo) {
    schema = Json{{"anyOf", {std::move(number), reference("QuantityText")}}};
  }
  if (!unit.empty()) schema["x-unit"] = unit;
  return schema;
}

struct SchemaOf {
  SchemaFor form;

  Json operator()(const NumberKind& kind) const { return number_schema(kind.unit, kind.range, form); }
  /// Where the road makes no difference.
  template <class OtherKind>
  Json operator()(const OtherKind& kind) const {
    return value_schema(kind);
  }
  Json operator()(const ListKind& kind) const {
    Json schema = value_schema(kind);
    schema["items"] = std::visit(SchemaOf{form}, *kind.element);
    return schema;
  }
  Json operator()(const SystemKind&) const {
    if (form == SchemaFor::query) return reference("SystemName");
    return {{"anyOf", {reference("SystemName"), reference("Scene")}}};
  }
  Json operator()(const SymbolsKind& kind) const {
    const bool is_input = kind.role == SymbolRole::input;
    if (form == SchemaFor::echo) {
      return {{"type", "object"}, {"additionalProperties", {{"type", is_input ? "string" : "number"}}}};
    }
    return {{"type", "object"}, {"additionalProperties", reference(is_input ? "TimeFunction" : "Quantity")}};
  }
  Json operator()(const ParameterValueKind& kind) const {
    Json schema = number_schema("", {}, form);
    schema["x-unit-of"] = kind.parameter;
    return schema;
  }
};

Json schema_of(const FieldInfo& field, SchemaFor form) {
  return described(std::visit(SchemaOf{form}, field.kind), field, form);
}

Json object_schema(const FieldSet& set, SchemaFor form) {
  Json properties = Json::object();
  Json required = Json::array();
  for (const FieldInfo& field : set.fields) {
    properties[field.name] = schema_of(field, form);
    if (field.need == Need::required) required.push_back(field.name);
  }
  return {{"type", "object"},
          {"properties", std::move(properties)},
          {"required", std::move(required)},
          {"additionalProperties", false}};
}

/// "At most one of: rtol and atol; accuracy; max_error."
std::string in_words(const OneOf& one_of) {
  std::string text = "At most one of:";
  const char* separator = " ";
  for (const std::vector<std::string>& way : one_of.ways) {
    const char* conjunction = "";
    text += separator;
    for (const std::string& field : way) {
      text += conjunction + field;
      conjunction = " and ";
    }
    separator = "; ";
  }
  return text + ".";
}

std::string in_words(const FieldSet& set) {
  std::string text;
  for (const OneOf& one_of : set.one_of) text += (text.empty() ? "" : " ") + in_words(one_of);
  return text;
}

/// k=40 or parameters.k=40; a place is said with its field's name only, equilibrium.theta=0.
Json flattened(const FieldInfo& field, SymbolRole role) {
  const Json value = reference(role == SymbolRole::input ? "TimeFunction" : "Quantity");
  Json schema{{"type", "object"}};
  if (role == SymbolRole::equilibrium || role == SymbolRole::position) {
    schema["patternProperties"] = {{"^" + field.name + "\\.", value}};
    schema["additionalProperties"] = false;
  } else {
    schema["additionalProperties"] = value;
  }
  return {{"name", field.name},
          {"in", "query"},
          {"description", field.description +
                              "; each stands alone, as name=value or, where it must be told from a field, " +
                              field.name + ".name=value"},
          {"style", "form"},
          {"explode", true},
          {"schema", std::move(schema)}};
}

Json query_parameter(const FieldInfo& field) {
  if (const auto* symbols = std::get_if<SymbolsKind>(&field.kind)) return flattened(field, symbols->role);
  Json parameter{{"name", field.name}, {"in", "query"}};
  parameter["required"] = field.need == Need::required;
  parameter["description"] = field.description;
  if (std::holds_alternative<ListKind>(field.kind)) parameter.update({{"style", "form"}, {"explode", false}});
  Json schema = schema_of(field, SchemaFor::query);
  schema.erase("description");
  parameter["schema"] = std::move(schema);
  return parameter;
}

}  // namespace

Json domain_json(const Domain& domain) {
  Json json = Json::object();
  if (std::isfinite(domain.lower)) json[domain.lower_open ? "exclusiveMinimum" : "minimum"] = domain.lower;
  if (std::isfinite(domain.upper)) json[domain.upper_open ? "exclusiveMaximum" : "maximum"] = domain.upper;
  return json;
}

Json body_schema(const FieldSet& set) {
  Json schema = object_schema(set, SchemaFor::body);
  if (!set.one_of.empty()) schema["description"] = in_words(set);
  append_rules(set, schema);
  return schema;
}

Json query_parameters(const FieldSet& set) {
  Json parameters = Json::array();
  for (const FieldInfo& field : set.fields) {
    parameters.push_back(query_parameter(field));
  }
  return parameters;
}

Json echo_schema(const FieldSet& set) {
  Json schema = object_schema(set, SchemaFor::echo);
  for (auto& [name, field] : schema["properties"].items()) {
    field.erase("x-aliases");
  }
  schema["description"] = "The request as it was understood: defaults filled in, SI units.";
  return schema;
}

Json shared_schemas() {
  const Json text{
      {"type", "string"},
      {"minLength", 1},
      {"description", "A number with a unit, or an expression of numbers and parameters in SI units."},
      {"examples", {"30deg", "12 cm", "2 rev/s", "9.81 m/s^2", "pi/6", "2*m*g/l"}}};
  const Json input{{"anyOf", {{{"type", "number"}}, value_schema(TextKind{limits::expression_bytes})}},
                   {"description", "An expression in t and the parameters."}};
  return {{"QuantityText", text},
          {"Quantity",
           {{"anyOf", {{{"type", "number"}}, reference("QuantityText")}},
            {"description", "A number in SI units, or a text: a quantity with its unit, or an expression."}}},
          {"TimeFunction", input}};
}

Json reference(const std::string& name) { return {{"$ref", "#/components/schemas/" + name}}; }

}  // namespace qdot::api
