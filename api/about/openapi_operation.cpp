#include "api/about/openapi_operation.hpp"

#include <algorithm>

#include "api/about/examples.hpp"
#include "api/about/openapi_texts.hpp"
#include "api/answers/endpoints.hpp"
#include "api/contract/json_schema.hpp"

namespace qdot::api {
namespace {

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
        const bool is_format = is_text(parameter["name"], "format");
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
      responses[std::to_string(status)] = {{"$ref", "#/components/responses/" + problem_response(status)}};
    return responses;
  }

  const Route& route_;
  const Endpoint* endpoint_;  ///< nullptr: the address computes nothing
  const Json& about_;
  std::string suffix_;  ///< ".csv": of an address that gives one form of the answer
  const Catalogue& catalogue_;
};

}  // namespace

Json openapi_operation(const Route& route, const Catalogue& catalogue) {
  return Operation(route, catalogue).json();
}

}  // namespace qdot::api
