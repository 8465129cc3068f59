#include "api/about/practice_sheet.hpp"

#include "api/about/agreement.hpp"
#include "api/about/embedded.hpp"
#include "api/json/documents.hpp"
#include "api/json/writer.hpp"

namespace qdot::api {
namespace {

std::string number_of(const Json& exercise) { return std::to_string(exercise["number"].get<int>()); }

/// The request as one line for a shell; no text of the sheet has a quotation mark that would end it.
std::string curl_of(const std::string& path, const std::string& body) {
  return "curl -d '" + body + "' localhost:8080" + path;
}

Json request_json(const Json& request) {
  const auto path = request["path"].get<std::string>();
  std::string body = to_text(request["body"]);
  body.pop_back();  // the newline
  return {{"method", "POST"}, {"path", path}, {"body", request["body"]}, {"curl", curl_of(path, body)}};
}

/// {"/modes/0/omega": ...}: the parts of the answer that the question is about.
Json picked(const Json& answer, const Json& pointers) {
  Json result = Json::object();
  for (const Json& pointer : pointers) {
    const Json::json_pointer place(pointer.get<std::string>());
    if (answer.contains(place)) result[pointer.get<std::string>()] = answer[place];
  }
  return result;
}

/// What the sheet says, with `agrees` in the place of the data that are compared. A problem is no answer to
/// compare with.
Json compared(const Json& sheet, int status, const Json& answer) {
  Json result = Json::object();
  for (const auto& [name, value] : sheet.items()) {
    if (name != "prints") {
      result[name] = value;
    } else if (status == 200) {
      result["agrees"] = agrees(value, answer);
    }
  }
  return result;
}

Json answered(const Json& part, const std::function<Response(const Request&)>& answer) {
  Json result = Json::object();
  if (part.contains("part")) result["part"] = part["part"];
  result["question"] = part["question"];
  result["request"] = request_json(part["request"]);
  const Response response = answer({.method = "POST",
                                    .target = part["request"]["path"].get<std::string>(),
                                    .headers = {{"content-type", "application/json"}},
                                    .body = to_text(part["request"]["body"])});
  const Json body = parse_json(response.body);
  result["result"] = picked(body, part["result"]);
  result["sheet"] = compared(part["sheet"], response.status, body);
  result["status"] = response.status;
  result["answer"] = body;
  return result;
}

}  // namespace

const Json& practice_sheet() {
  static const Json sheet = parse_json(text_of(about_files(), "practice_sheet.json"));
  return sheet;
}

Json exercise_list() {
  Json list = Json::array();
  for (const Json& exercise : practice_sheet()) {
    Json parts = Json::array();
    for (const Json& part : exercise["parts"]) {
      Json entry = Json::object();
      if (part.contains("part")) entry["part"] = part["part"];
      entry["question"] = part["question"];
      entry["system"] = part["request"]["body"]["system"];
      parts.push_back(std::move(entry));
    }
    list.push_back({{"number", exercise["number"]},
                    {"title", exercise["title"]},
                    {"parts", std::move(parts)},
                    {"href", "/v1/problems/" + number_of(exercise)}});
  }
  return {{"problems", std::move(list)}};
}

std::optional<Json> answered_exercise(std::string_view number,
                                      const std::function<Response(const Request&)>& answer) {
  for (const Json& exercise : practice_sheet()) {
    if (number_of(exercise) != number) continue;
    Json parts = Json::array();
    for (const Json& part : exercise["parts"]) parts.push_back(answered(part, answer));
    return Json{{"number", exercise["number"]}, {"title", exercise["title"]}, {"parts", std::move(parts)}};
  }
  return std::nullopt;
}

}  // namespace qdot::api
