#include "api/about/openapi.hpp"

#include <map>

#include "api/about/openapi_operation.hpp"
#include "api/about/openapi_schemas.hpp"
#include "api/about/openapi_texts.hpp"
#include "api/contract/json_schema.hpp"
#include "api/contract/version.hpp"
#include "api/http/problem.hpp"

namespace qdot::api {
namespace {

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
    responses[problem_response(status)] = std::move(response);
  }
  return responses;
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
  return {{"schemas", openapi_schemas(catalogue)},
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
    paths[route.pattern][route.method == "GET" ? "get" : "post"] = openapi_operation(route, catalogue);
  }
  return {{"openapi", "3.1.0"},
          {"jsonSchemaDialect", "https://json-schema.org/draft/2020-12/schema"},
          {"info", information()},
          {"servers", {{{"url", "/"}}}},
          {"security", {Json::object(), {{"token", Json::array()}}}},
          {"tags", shared_description()["tags"]},
          {"paths", std::move(paths)},
          {"components", components(catalogue)}};
}

}  // namespace qdot::api
