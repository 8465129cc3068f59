#include "api/about/openapi_schemas.hpp"

#include "api/about/embedded.hpp"
#include "api/about/openapi_texts.hpp"
#include "api/answers/endpoints.hpp"
#include "api/contract/json_schema.hpp"
#include "api/json/documents.hpp"
#include "api/scenes/scene_table.hpp"
#include "core/integrate/methods.hpp"

namespace qdot::api {
namespace {

/// "held_length" is SceneHeldLength.
std::string name_of_definition(std::string_view name) {
  std::string result = "Scene";
  bool starts_word = true;
  for (const char c : name) {
    if (c != '_') result += starts_word ? static_cast<char>(c - 'a' + 'A') : c;
    starts_word = c == '_';
  }
  return result;
}

/// Objects that exclude each other by their `kind`, said in OpenAPI's way instead of by if and then.
void tell_apart_by_kind(Json& value) {
  Json choices = Json::array();
  Json mapping = Json::object();
  for (const Json& part : value["allOf"]) {
    choices.push_back(part["then"]);
    mapping[part["if"]["properties"]["kind"]["const"].get<std::string>()] = part["then"]["$ref"];
  }
  value = {{"oneOf", std::move(choices)},
           {"discriminator", {{"propertyName", "kind"}, {"mapping", std::move(mapping)}}}};
}

/// References inside the schema of a scene, moved to where its definitions stand here.
void move_references(Json& value) {
  if (value.is_object() && value.contains("$ref")) {
    const auto name = value["$ref"].get<std::string>().substr(std::string_view("#/$defs/").size());
    value["$ref"] = reference(name_of_definition(name))["$ref"];
  }
  if (value.is_structured()) {
    for (Json& part : value) move_references(part);
  }
  const bool is_choice = value.is_object() && value.contains("allOf") && value["allOf"][0].contains("if");
  if (is_choice) tell_apart_by_kind(value);
}

/// As in the bodies of requests: a client that is generated takes a member with a `default` for one that is
/// always there.
void say_defaults_in_words(Json& schema) {
  if (!schema.contains("properties")) return;
  for (auto& [name, member] : schema["properties"].items()) {
    if (!member.contains("default")) continue;
    member["description"] =
        member.value("description", "") + " (default " + dump_json(member["default"]) + ")";
    member.erase("default");
  }
}

/// The schema of a scene and its definitions, each a component.
Json scene_components() {
  Json scene = scene_schema();
  for (const char* name : {"$schema", "$id"}) scene.erase(name);
  const Json definitions = scene["$defs"];
  scene.erase("$defs");
  Json all = Json::object();
  all["Scene"] = std::move(scene);
  for (const auto& [name, definition] : definitions.items()) all[name_of_definition(name)] = definition;
  for (Json& schema : all) {
    move_references(schema);
    say_defaults_in_words(schema);
  }
  return all;
}

/// What the members of answers are, where their schema does not say it itself. "System.method" is said of the
/// schema System alone.
const Json& glossary() {
  static const Json file = parse_json(text_of(about_files(), "glossary.json"));
  return file;
}

void describe_members(Json& value, const std::string& schema) {
  if (!value.is_structured()) return;
  if (value.is_object() && value.contains("properties")) {
    for (auto& [name, member] : value["properties"].items()) {
      if (!member.is_object() || member.contains("description") || member.contains("$ref")) continue;
      const std::string special = schema + "." + name;
      const std::string& key = glossary().contains(special) ? special : name;
      if (glossary().contains(key)) member["description"] = glossary()[key];
    }
  }
  for (Json& part : value) describe_members(part, schema);
}

Json notes_schema() {
  return {{"type", "array"},
          {"items", {{"type", "string"}}},
          {"description",
           "How values were understood that could be meant otherwise, and what else should be known."}};
}

/// The members that every computed answer begins with.
Json with_head(const Json& answer, const std::string& request) {
  Json result = answer;
  Json& properties = result["properties"] = {{"system", {{"type", "string"}}},
                                             {"model_version", {{"type", "string"}}},
                                             {"service_version", {{"type", "string"}}},
                                             {"request", reference(request)},
                                             {"notes", notes_schema()}};
  properties.update(answer["properties"]);
  Json& required = result["required"] = {"system", "model_version", "service_version", "request"};
  for (const Json& name : answer["required"]) required.push_back(name);
  return result;
}

/// The names of the methods of integration.
Json method_schema() {
  Json names = Json::array();
  for (const MethodRecord& method : methods()) names.push_back(method.name);
  return {{"type", "string"}, {"enum", std::move(names)}};
}

}  // namespace

Json openapi_schemas(const Catalogue& catalogue) {
  Json all = shared_description()["schemas"];
  all.update(shared_schemas());
  std::vector<std::string> systems = catalogue.names();
  for (const std::string& classic : classic_names()) {
    if (catalogue.find(classic) == nullptr) systems.push_back(classic);
  }
  all["SystemName"] = {{"type", "string"}, {"enum", systems}};
  all.update(scene_components());
  all["Method"] = method_schema();
  for (const Json& about : descriptions()) {
    if (about.contains("schema")) all[about["answer"].get<std::string>()] = about["schema"];
    if (about.contains("detail")) all[about["answer"].get<std::string>() + "InDetail"] = about["detail"];
  }
  for (const Endpoint& endpoint : endpoints()) {
    const auto answer = descriptions()[address_of(endpoint)]["answer"].get<std::string>();
    all[answer + "Request"] = body_schema(*endpoint.question.fields);
    if (!asks_about_a_system(endpoint)) continue;
    all[answer + "Echo"] = echo_schema(*endpoint.question.fields);
    all[answer] = with_head(all[answer], answer + "Echo");
  }
  for (auto& [name, schema] : all.items()) describe_members(schema, name);
  return all;
}

}  // namespace qdot::api
