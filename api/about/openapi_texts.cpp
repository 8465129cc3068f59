#include "api/about/openapi_texts.hpp"

#include "api/about/embedded.hpp"
#include "api/answers/endpoints.hpp"
#include "api/json/documents.hpp"

namespace qdot::api {

const Json& shared_description() {
  static const Json file = parse_json(text_of(about_files(), "openapi.json"));
  return file;
}

const Json& descriptions() {
  static const Json all = [] {
    Json result = Json::object();
    for (const EmbeddedFile& file : address_files()) result.update(parse_json(file.text));
    for (const Endpoint& endpoint : endpoints()) result[address_of(endpoint)] = description_of(endpoint);
    return result;
  }();
  return all;
}

std::string problem_response(int status) { return "Problem" + std::to_string(status); }

}  // namespace qdot::api
