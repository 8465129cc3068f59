#include "api/about/openapi.hpp"

#include <algorithm>
#include <map>

#include "api/about/embedded.hpp"
#include "api/about/examples.hpp"
#include "api/answers/endpoints.hpp"
#include "api/contract/json_schema.hpp"
#include "api/contract/version.hpp"
#include "api/http/problem.hpp"
#include "api/scenes/scene_table.hpp"
#include "core/integrate/methods.hpp"

namespace qdot::api {
namespace {

/// What belongs to no single address: tags, and schemas that several answers share.
const Json& shared() {
  static const Json file = Json::parse(text_of(about_files(), "openapi.json"));
  return file;
}

/// What is said of each address: {"/v1/energy": {"summary": ..., "answer": "Energies", "schema": ...}}.
const Json& descriptions() {
  static const Json all = [] {
    Json result = Json::object();
    for (const EmbeddedFile& file : address_files()) result.update(Json::parse(file.text));
    for (const Endpoint& endpoint : endpoints()) result[address_of(endpoint)] = description_of(endpoint);
    return result;
  }();
  return all;
}

std::string response_name(int status) { return "Problem" + std::to_string(status); }

/// Headers that belong to a status alone.
Json headers_of(int status) {
  const auto text = [](const char* meaning) {
    return Json{{"description", meaning}, {"schema", {{"type", "string"}}}};
  };
  if (status == 401) return {{"WWW-Authenticate", text("Bearer")}};
  if (status == 405) return {{"Allow", text("The methods that the address knows.")}};
  if (status == 503) {
    return {{"Retry-After",
             {{"description", "Seconds to wait."}, {"schema", {{"type", "integer"}, {"minimum", 1}}}}}};
  }
  return Json::object();
}

/// One response for each status that a problem can have.
Json problem_responses() {
  std::map<int, std::vector<const ProblemType*>> by_status;
  for (const ProblemType& type : problem_types()) by_status[type.status].push_back(&type);
  Json responses = Json::object();
  for (const auto& [status, types] : by_status) {
    std::string description;
    Json uris = Json::array();
    for (const ProblemType* type : types) {
      description += (description.empty() ? "" : "; or: ") + std::string(type->title);
      uris.push_back("/errors/" + std::string(type->name));
    }
    Json schema = reference("Problem");
    schema["properties"] = {{"status", {{"const", status}}}, {"type", {{"enum", std::move(uris)}}}};
    Json response{{"description", std::move(description)},
                  {"content", {{"application/problem+json", {{"schema", std::move(schema)}}}}}};
    if (status == 404) response["content"]["text/html"] = {{"schema", {{"type", "string"}}}};  // to a browser
    if (const Json headers = headers_of(status); !headers.empty()) response["headers"] = headers;
    responses[response_name(status)] = std::move(response);
  }
  return responses;
}

/// With which statuses a request can fail.
std::vector<int> problems_of(const Route& route) {
  std::vector<int> statuses{400, 401, 403, 405, 406, 408, 414, 417, 421, 431, 500, 503};
  if (route.pattern.find('{') != std::string::npos) statuses.push_back(404);
  if (route.method == "POST") statuses.insert(statuses.end(), {411, 413, 415});
  if (endpoint_at(route.pattern) != nullptr) statuses.push_back(422);
  std::ranges::sort(statuses);
  return statuses;
}

std::string capitalized(std::string name) {
  name[0] = static_cast<char>(name[0] - 'a' + 'A');
  return name;
}

class Operation {
 public:
  Operation(const Route& route, const Catalogue& catalogue)
      : route_(route),
        endpoint_(endpoint_at(route.pattern)),
        about_(descriptions().at(endpoint_ == nullptr ? route.pattern : address_of(*endpoint_))),
        suffix_(endpoint_ == nullptr ? "" : route.pattern.substr(address_of(*endpoint_).size())),
        catalogue_(catalogue) {}

  [[nodiscard]] Json json() const {
    const bool is_post = route_.method == "POST";
    const auto id = about_["operation"].get<std::string>();
    Json json{
        {"tags", {about_["tag"]}},
        {"summary", in_its_form(about_["summary"].get<std::string>())},
        {"description", about_["description"]},
        {"operationId", endpoint_ == nullptr ? id : (is_post ? "post" : "get") + capitalized(id) + form()}};
    if (const Json all = parameters(is_post); !all.empty()) json["parameters"] = all;
    if (is_post) json["requestBody"] = body();
    json["responses"] = responses();
    return json;
  }

 private:
  /// "Csv"
  [[nodiscard]] std::string form() const { return suffix_.empty() ? "" : capitalized(suffix_.substr(1)); }

  /// "A motion (CSV)"
  [[nodiscard]] std::string in_its_form(std::string text) const {
    if (suffix_.empty()) return text;
    std::string letters = suffix_.substr(1);
    for (char& c : letters) c = static_cast<char>(c - 'a' + 'A');
    return text + " (" + letters + ")";
  }

  [[nodiscard]] Json parameters(bool is_post) const {
    Json all = Json::array();
    if (about_.contains("capture")) {
      const std::size_t open = route_.pattern.find('{') + 1;
      all.push_back({{"name", route_.pattern.substr(open, route_.pattern.find('}') - open)},
                     {"in", "path"},
                     {"required", true},
                     {"description", about_["capture"]},
                     {"schema", {{"type", "string"}}}});
    }
    for (const Json& parameter : about_.value("query", Json::array())) all.push_back(parameter);
    if (endpoint_ != nullptr) {
      for (const Json& parameter : query_parameters(*endpoint_->question.fields)) {
        const bool is_format = parameter["name"] == "format";
        if (is_format ? suffix_.empty() : !is_post) all.push_back(parameter);
      }
    }
    if (route_.offers[0] == "application/json") all.push_back({{"$ref", "#/components/parameters/pretty"}});
    return all;
  }

  [[nodiscard]] Json body() const {
    const auto schema = about_["answer"].get<std::string>() + "Request";
    if (endpoint_->body_type != "application/json") {
      return {{"required", true}, {"content", {{endpoint_->body_type, {{"schema", lines_of(schema)}}}}}};
    }
    const Json examples =
        request_examples(address_of(*endpoint_), about_.value("examples", Json::array()), catalogue_);
    return {{"required", true},
            {"content", {{"application/json", {{"schema", reference(schema)}, {"examples", examples}}}}}};
  }

  /// Lines of JSON.
  [[nodiscard]] static Json lines_of(const std::string& schema) {
    return {{"type", "string"},
            {"description", "Lines, each a " + schema + " in JSON."},
            {"contentMediaType", "application/x-ndjson"},
            {"contentSchema", reference(schema)}};
  }

  [[nodiscard]] Json responses() const {
    Json content = Json::object();
    for (const std::string& type : route_.offers) {
      // A client that is generated has one type for each address: the other forms have addresses of their
      // own.
      if (suffix_.empty() && endpoint_ != nullptr && !suffix_of(*endpoint_, type).empty()) continue;
      const bool is_json = type == "application/json" || type.ends_with("+json");
      const auto answer = about_.value("answer", "");  // a page has none
      const bool has_lines = endpoint_ != nullptr && type == endpoint_->body_type;
      const Json text = has_lines ? lines_of(answer) : Json{{"type", "string"}};
      content[type] = {{"schema", is_json ? reference(answer) : text}};
    }
    Json responses{{"200", {{"description", about_["summary"]}, {"content", std::move(content)}}}};
    if (route_.method == "GET") {
      responses["200"]["headers"] = {{"ETag", {{"schema", {{"type", "string"}}}}}};
      responses["304"] = {
          {"description", "The answer is still the one with the entity tag in If-None-Match."}};
    }
    std::vector<int> problems = problems_of(route_);
    if (endpoint_ == nullptr && about_.contains("query")) problems.push_back(422);
    for (const int status : problems)
      responses[std::to_string(status)] = {{"$ref", "#/components/responses/" + response_name(status)}};
    return responses;
  }

  const Route& route_;
  const Endpoint* endpoint_;  ///< nullptr: the address computes nothing
  const Json& about_;
  std::string suffix_;  ///< ".csv": of an address that gives one form of the answer
  const Catalogue& catalogue_;
};

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
    member["description"] = member.value("description", "") + " (default " + member["default"].dump() + ")";
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
  static const Json file = Json::parse(text_of(about_files(), "glossary.json"));
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

Json schemas(const Catalogue& catalogue) {
  Json all = shared()["schemas"];
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

Json information() {
  return {
      {"title", "qdot"},
      {"version", service_version()},
      {"summary", "Lagrangian mechanics, each number with its error."},
      {"description",
       "Numbers in answers are in SI units and radians. So are numbers in requests; a text may carry another "
       "unit, \"30deg\". The same request has the same answer, byte for byte. Every error is "
       "application/problem+json. HEAD is answered like GET, and OPTIONS with the Allow header."},
      {"license", {{"name", "MIT"}, {"identifier", "MIT"}}}};
}

Json components(const Catalogue& catalogue) {
  const Json pretty{{"name", "pretty"},
                    {"in", "query"},
                    {"description", "Indent the answer."},
                    {"allowEmptyValue", true},
                    {"schema", {{"type", "boolean"}}}};
  return {{"schemas", schemas(catalogue)},
          {"responses", problem_responses()},
          {"parameters", {{"pretty", pretty}}},
          {"securitySchemes",
           {{"token",
             {{"type", "http"},
              {"scheme", "bearer"},
              {"description", "Needed only where the service was started with a token."}}}}}};
}

}  // namespace

Json openapi_document(const Routes& routes, const Catalogue& catalogue) {
  Json paths = Json::object();
  for (const Route& route : routes.all()) {
    paths[route.pattern][route.method == "GET" ? "get" : "post"] = Operation(route, catalogue).json();
  }
  return {{"openapi", "3.1.0"},
          {"jsonSchemaDialect", "https://json-schema.org/draft/2020-12/schema"},
          {"info", information()},
          {"servers", {{{"url", "/"}}}},
          {"security", {Json::object(), {{"token", Json::array()}}}},
          {"tags", shared()["tags"]},
          {"paths", std::move(paths)},
          {"components", components(catalogue)}};
}

}  // namespace qdot::api
