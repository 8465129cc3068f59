#include "api/about/openapi.hpp"

#include <algorithm>
#include <map>

#include "api/about/embedded.hpp"
#include "api/about/openapi_examples.hpp"
#include "api/contract/json_schema.hpp"
#include "api/contract/version.hpp"
#include "api/http/problem.hpp"
#include "api/scenes/scene_table.hpp"

namespace qdot::api {
namespace {

const Json& addresses() {
  static const Json file = Json::parse(text_of(about_files(), "addresses.json"));
  return file;
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
    if (const Json headers = headers_of(status); !headers.empty()) response["headers"] = headers;
    responses[response_name(status)] = std::move(response);
  }
  return responses;
}

/// With which statuses a request to this endpoint can fail.
std::vector<int> problems_of(const Endpoint& endpoint) {
  std::vector<int> statuses{400, 401, 403, 405, 406, 408, 414, 417, 421, 431, 500, 503};
  if (endpoint.pattern.find('{') != std::string::npos) statuses.push_back(404);
  if (endpoint.method == "POST") statuses.insert(statuses.end(), {411, 413, 415});
  if (endpoint.fields != nullptr) statuses.push_back(422);
  std::ranges::sort(statuses);
  return statuses;
}

std::string capitalized(std::string name) {
  name[0] = static_cast<char>(name[0] - 'a' + 'A');
  return name;
}

class Operation {
 public:
  Operation(const Endpoint& endpoint, const Catalogue& catalogue)
      : endpoint_(endpoint), about_(addresses()["addresses"].at(endpoint.pattern)), catalogue_(catalogue) {}

  [[nodiscard]] Json json() const {
    const bool is_post = endpoint_.method == "POST";
    const auto id = about_["operation"].get<std::string>();
    Json json{
        {"tags", {about_["tag"]}},
        {"summary", about_["summary"]},
        {"description", about_["description"]},
        {"operationId", endpoint_.fields == nullptr ? id : (is_post ? "post" : "get") + capitalized(id)}};
    if (const Json all = parameters(is_post); !all.empty()) json["parameters"] = all;
    if (is_post) json["requestBody"] = body();
    json["responses"] = responses();
    return json;
  }

 private:
  [[nodiscard]] Json parameters(bool is_post) const {
    Json all = Json::array();
    if (about_.contains("capture")) {
      const std::size_t open = endpoint_.pattern.find('{') + 1;
      all.push_back({{"name", endpoint_.pattern.substr(open, endpoint_.pattern.find('}') - open)},
                     {"in", "path"},
                     {"required", true},
                     {"description", about_["capture"]},
                     {"schema", {{"type", "string"}}}});
    }
    if (endpoint_.fields != nullptr) {
      for (const Json& parameter : query_parameters(*endpoint_.fields)) {
        if (!is_post || parameter["name"] == "format") all.push_back(parameter);
      }
    }
    if (endpoint_.offers[0] == "application/json")
      all.push_back({{"$ref", "#/components/parameters/pretty"}});
    return all;
  }

  [[nodiscard]] Json body() const {
    const Json examples =
        request_examples(endpoint_.pattern, about_.value("examples", Json::array()), catalogue_);
    return {{"required", true},
            {"content",
             {{"application/json",
               {{"schema", reference(about_["answer"].get<std::string>() + "Request")},
                {"examples", examples}}}}}};
  }

  [[nodiscard]] Json responses() const {
    Json content = Json::object();
    for (const std::string& type : endpoint_.offers) {
      const bool is_json = type == "application/json" || type.ends_with("+json");
      content[type] = {
          {"schema", is_json ? reference(about_["answer"].get<std::string>()) : Json{{"type", "string"}}}};
    }
    Json responses{{"200", {{"description", about_["summary"]}, {"content", std::move(content)}}}};
    if (endpoint_.method == "GET") {
      responses["200"]["headers"] = {{"ETag", {{"schema", {{"type", "string"}}}}}};
      responses["304"] = {{"description", "The entity tag in If-None-Match still holds."}};
    }
    for (const int status : problems_of(endpoint_)) {
      responses[std::to_string(status)] = {{"$ref", "#/components/responses/" + response_name(status)}};
    }
    return responses;
  }

  const Endpoint& endpoint_;
  const Json& about_;
  const Catalogue& catalogue_;
};

/// References inside the schema of a scene, moved to where it stands here.
void move_references(Json& value) {
  if (value.is_object() && value.contains("$ref")) {
    value["$ref"] = "#/components/schemas/Scene" + value["$ref"].get<std::string>().substr(1);
  }
  if (value.is_structured()) {
    for (Json& part : value) move_references(part);
  }
}

Json scene_component() {
  Json scene = scene_schema();
  for (const char* name : {"$schema", "$id"}) scene.erase(name);
  move_references(scene);
  return scene;
}

/// The members that every computed answer begins with.
Json with_head(const Json& answer, const std::string& request) {
  Json result = answer;
  Json& properties = result["properties"] = {{"system", {{"type", "string"}}},
                                             {"model_version", {{"type", "string"}}},
                                             {"service_version", {{"type", "string"}}},
                                             {"request", reference(request)}};
  properties.update(answer["properties"]);
  Json& required = result["required"] = {"system", "model_version", "service_version", "request"};
  for (const Json& name : answer["required"]) required.push_back(name);
  return result;
}

Json schemas(const Routes& routes, const Catalogue& catalogue) {
  Json all = Json::parse(text_of(about_files(), "answers.json"));
  all.update(shared_schemas());
  all["SystemName"] = {{"type", "string"}, {"enum", catalogue.names()}};
  all["Scene"] = scene_component();
  for (const Endpoint& endpoint : routes.endpoints()) {
    if (endpoint.fields == nullptr || endpoint.method != "POST") continue;
    const auto answer = addresses()["addresses"].at(endpoint.pattern)["answer"].get<std::string>();
    all[answer + "Request"] = body_schema(*endpoint.fields);
    all[answer + "Echo"] = echo_schema(*endpoint.fields);
    all[answer] = with_head(all[answer], answer + "Echo");
  }
  return all;
}

Json information() {
  return {
      {"title", "qdot"},
      {"version", service_version()},
      {"summary", "Lagrangian mechanics, each number with its error."},
      {"description",
       "Numbers that go out are in SI units and radians; a number that comes in is too, or is a text "
       "with its unit, \"30deg\". Bodies are deterministic. Every error is application/problem+json. HEAD "
       "is answered as GET, OPTIONS with Allow."},
      {"license", {{"name", "MIT"}, {"identifier", "MIT"}}}};
}

Json components(const Routes& routes, const Catalogue& catalogue) {
  const Json pretty{{"name", "pretty"},
                    {"in", "query"},
                    {"description", "Indent the answer."},
                    {"allowEmptyValue", true},
                    {"schema", {{"type", "boolean"}}}};
  return {{"schemas", schemas(routes, catalogue)},
          {"responses", problem_responses()},
          {"parameters", {{"pretty", pretty}}},
          {"securitySchemes",
           {{"token",
             {{"type", "http"},
              {"scheme", "bearer"},
              {"description", "Only where the service was started with a token."}}}}}};
}

}  // namespace

Json openapi_document(const Routes& routes, const Catalogue& catalogue) {
  Json paths = Json::object();
  for (const Endpoint& endpoint : routes.endpoints()) {
    const std::string method = endpoint.method == "GET" ? "get" : "post";
    paths[endpoint.pattern][method] = Operation(endpoint, catalogue).json();
  }
  return {{"openapi", "3.1.0"},
          {"jsonSchemaDialect", "https://json-schema.org/draft/2020-12/schema"},
          {"info", information()},
          {"servers", {{{"url", "/"}}}},
          {"security", {Json::object(), {{"token", Json::array()}}}},
          {"tags", addresses()["tags"]},
          {"paths", std::move(paths)},
          {"components", components(routes, catalogue)}};
}

}  // namespace qdot::api
