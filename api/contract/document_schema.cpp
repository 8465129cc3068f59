#include "api/contract/document_schema.hpp"

#include <functional>
#include <utility>

#include "api/contract/domain_text.hpp"
#include "api/contract/names.hpp"
#include "api/json/limits.hpp"

namespace qdot::api {
namespace {

Json text_schema(std::size_t most_bytes) {
  return {{"type", "string"}, {"minLength", 1}, {"maxLength", most_bytes}};
}

/// What is_name says. `suffix` is the end that a name may have beside, if any.
Json name_schema(const std::string& description, const std::string& suffix) {
  std::string reserved;
  for (const std::string& name : reserved_names()) reserved += (reserved.empty() ? "" : "|") + name;
  const std::string end = suffix.empty() ? "" : "(" + suffix + ")?";
  const std::string velocity_or_acceleration = suffix.empty() ? "_d?dot$" : "(_ddot|_d?dot_dot)$";
  return {{"description", description},
          {"type", "string"},
          {"maxLength", limits::name_bytes + suffix.size()},
          {"pattern", "^[A-Za-z][A-Za-z0-9_]*$"},
          {"not",
           {{"anyOf",
             {{{"pattern", velocity_or_acceleration}}, {{"pattern", "^(" + reserved + ")" + end + "$"}}}}}}};
}

/// Writes schemas, each definition once: into `definitions`, or where there are none, in its place.
class Writer {
 public:
  explicit Writer(Json* definitions) : definitions_(definitions) {}

  Json of(const Kind& kind) {
    return std::visit([this](const auto& k) { return (*this)(k); }, kind);
  }

  Json object(const FieldSet& set) {
    Json schema{{"description", set.description}, {"type", "object"}, {"additionalProperties", false}};
    schema["required"] = Json::array();
    schema["properties"] = Json::object();
    for (const FieldInfo& field : set.fields) {
      Json property = of(field.kind);
      property["description"] = field.description;
      if (!field.default_value.is_null()) property["default"] = field.default_value;
      schema["properties"][field.name] = std::move(property);
      if (field.need == Need::required) schema["required"].push_back(field.name);
    }
    append_rules(set, schema);
    return schema;
  }

  Json operator()(const NumberKind&) { return {{"type", "number"}}; }
  Json operator()(const IntegerKind& kind) {
    return {{"type", "integer"}, {"minimum", kind.least}, {"maximum", kind.most}};
  }
  Json operator()(const BooleanKind&) { return {{"type", "boolean"}}; }
  Json operator()(const TextKind& kind) { return text_schema(kind.most_bytes); }
  Json operator()(const ChoiceKind& kind) { return {{"type", "string"}, {"enum", kind.options}}; }
  Json operator()(const SignKind&) { return {{"enum", {1, -1}}}; }
  Json operator()(const NameKind& kind) {
    if (kind.of == NameOf::thing_or_velocity) {
      return defined("symbol", [] {
        return name_schema("A name, or the velocity of a coordinate: theta, theta_dot.", "_dot");
      });
    }
    return defined("name", [] {
      return name_schema(
          "ASCII letters, digits and underscores after a letter; not ending in _dot or _ddot, which say "
          "velocity and acceleration, and not a name that expressions have already.",
          "");
    });
  }
  Json operator()(const ExpressionKind&) {
    return defined("expression", [] {
      Json schema = text_schema(limits::expression_bytes);
      schema["type"] = {"string", "number"};
      schema["description"] = "An expression in text, such as -l*cos(theta), or a number.";
      return schema;
    });
  }
  Json operator()(const VectorKind&) {
    return defined("vector", [this] {
      return Json{{"type", "array"}, {"minItems", 2}, {"maxItems", 3}, {"items", of(ExpressionKind{})}};
    });
  }
  Json operator()(const PositionKind&) {
    return defined("position", [this] {
      return Json{
          {"description",
           "The name of a point, or its components in an inertial frame: x, y (up) in the plane; x, y, z "
           "(up) in space."},
          {"oneOf", {of(NameKind{}), of(VectorKind{})}}};
    });
  }
  Json operator()(const DomainKind&) {
    return defined("domain", [] {
      return Json{
          {"description",
           "One bound or two, such as \"> 0\" or \">= 0, < 1\". Without it, every number is allowed."},
          {"type", "string"},
          {"pattern", domain_pattern()}};
    });
  }
  Json operator()(const ListKind& kind) {
    Json schema{{"type", "array"}, {"items", of(*kind.element)}, {"maxItems", kind.most}};
    if (kind.least > 0) schema["minItems"] = kind.least;
    if (std::holds_alternative<ChoiceKind>(*kind.element)) schema["uniqueItems"] = true;
    return schema;
  }
  Json operator()(const RecordKind& kind) {
    return defined(kind.set->name, [&] { return object(*kind.set); });
  }
  /// The objects exclude each other by their `kind`; "if" says so to those who print what is wrong.
  Json operator()(const VariantKind& kind) {
    Json names = Json::array();
    Json cases = Json::array();
    for (const FieldSet* set : kind.sets) {
      names.push_back(set->name);
      cases.push_back(
          {{"if", {{"properties", {{"kind", {{"const", set->name}}}}}}}, {"then", of(RecordKind{set})}});
    }
    return {{"type", "object"},
            {"required", Json::array({"kind"})},
            {"properties", {{"kind", {{"enum", std::move(names)}}}}},
            {"allOf", std::move(cases)}};
  }
  Json operator()(const MapKind& kind) {
    return {{"type", "object"},
            {"maxProperties", kind.most},
            {"propertyNames", of(NameKind{kind.keys})},
            {"additionalProperties", kind.values == MapTo::names ? of(NameKind{}) : of(ExpressionKind{})}};
  }
  // These speak of the system of a request, and no document has one: what they allow depends on it.
  Json operator()(const SystemKind&) { return Json::object(); }
  Json operator()(const SymbolsKind&) { return {{"type", "object"}}; }
  Json operator()(const ParameterValueKind&) { return Json::object(); }
  Json operator()(const AnyKind& kind) { return kind.schema; }

 private:
  Json defined(const std::string& name, const std::function<Json()>& write) {
    if (definitions_ == nullptr) return write();
    if (!definitions_->contains(name)) {
      (*definitions_)[name] = nullptr;  // keeps its place before those that it refers to
      (*definitions_)[name] = write();
    }
    return {{"$ref", "#/$defs/" + name}};
  }

  Json* definitions_;
};

}  // namespace

Json document_schema(const FieldSet& set, const std::string& id) {
  Json schema{{"$schema", "https://json-schema.org/draft/2020-12/schema"}, {"$id", id}, {"title", set.name}};
  Json definitions = Json::object();
  schema.update(Writer(&definitions).object(set));
  schema["$defs"] = std::move(definitions);
  return schema;
}

Json value_schema(const Kind& kind) { return Writer(nullptr).of(kind); }

void append_rules(const FieldSet& set, Json& schema) {
  Json rules = Json::array();
  for (const OneOf& one_of : set.one_of) {
    Json openings = Json::array();
    for (std::size_t i = 0; i < one_of.ways.size(); ++i) {
      openings.push_back({{"required", Json::array({one_of.ways[i].front()})}});
      for (std::size_t j = i + 1; j < one_of.ways.size(); ++j) {
        for (const std::string& a : one_of.ways[i]) {
          for (const std::string& b : one_of.ways[j]) rules.push_back({{"not", {{"required", {a, b}}}}});
        }
      }
    }
    if (one_of.need == Need::required) rules.push_back({{"anyOf", std::move(openings)}});
  }
  if (!rules.empty()) schema["allOf"] = std::move(rules);
}

}  // namespace qdot::api
