#include "api/answers/check/formats.hpp"
#include "api/json/documents.hpp"

#include <string>

namespace qdot::api {
namespace {

std::string understood_text(const Json& understood) {
  if (!understood.is_object()) return "";
  if (understood.contains("text")) {
    const Json& text = understood["text"];
    return "Read as: " + (text.is_string() ? text.get<std::string>() : dump_json(text)) + "\n";
  }
  return understood.contains("value") ? "Read as: " + dump_json(understood["value"]) + "\n" : "";
}

/// What a student reads about one item.
std::string output_of(const Json& item) {
  std::string text = item["correct"].is_null()       ? "Not graded.\n"
                     : item["correct"] == Json(true) ? "Right.\n"
                                                     : "Not right.\n";
  text += understood_text(item["understood"]);
  for (const char* list : {"format_errors", "feedback"}) {
    for (const Json& line : item[list]) text += line.get<std::string>() + "\n";
  }
  if (item["diagnosis"].is_object()) text += item["diagnosis"]["text"].get<std::string>() + "\n";
  if (item["counterexample"].is_object()) text += "Try: " + dump_json(item["counterexample"]) + "\n";
  text.pop_back();
  return text;
}

Json for_gradescope(const Json& grades) {
  Json tests = Json::array();
  for (const Json& item : grades["items"]) {
    tests.push_back({{"name", item["id"]},
                     {"number", std::to_string(tests.size() + 1)},
                     {"score", item["score"]},
                     {"max_score", item["points"]},
                     {"output", output_of(item)},
                     {"visibility", "visible"}});
  }
  return {{"output", ""},
          {"visibility", "visible"},
          {"stdout_visibility", "hidden"},
          {"tests", std::move(tests)}};
}

Json for_prairielearn(const Json& grades) {
  Json tests = Json::array();
  for (const Json& item : grades["items"]) {
    tests.push_back({{"name", item["id"]},
                     {"points", item["score"]},
                     {"max_points", item["points"]},
                     {"output", output_of(item)}});
  }
  Json format_errors = Json::array();
  for (const Json& error : grades["format_errors"]) {
    format_errors.push_back(error["id"].get<std::string>() + ": " + error["message"].get<std::string>());
  }
  return {{"gradable", grades["gradable"]},
          {"score", grades["score"]},
          {"message", ""},
          {"format_errors", std::move(format_errors)},
          {"tests", std::move(tests)}};
}

std::string as_html(const std::string& text) {
  std::string html;
  for (const char c : text) {
    switch (c) {
      case '<':
        html += "&lt;";
        break;
      case '>':
        html += "&gt;";
        break;
      case '&':
        html += "&amp;";
        break;
      case '"':
        html += "&quot;";
        break;
      case '\n':
        html += "<br>";
        break;
      default:
        html += c;
    }
  }
  return html;
}

Json for_coderunner(const Json& grades) {
  Json rows = Json::array({Json::array({"iscorrect", "Question", "Result", "Mark"})});
  for (const Json& item : grades["items"]) {
    rows.push_back(Json::array({item["correct"] == Json(true) ? 1 : 0, as_html(item["id"].get<std::string>()),
                                as_html(output_of(item)), item["score"]}));
  }
  // One for each column that is shown: %s is text, %h is HTML.
  return {{"fraction", grades["score"]},
          {"testresults", std::move(rows)},
          {"columnformats", Json::array({"%h", "%h", "%s"})}};
}

}  // namespace

Json in_format(const Json& grades, GradeFormat format) {
  switch (format) {
    case GradeFormat::json:
      return grades;
    case GradeFormat::gradescope:
      return for_gradescope(grades);
    case GradeFormat::prairielearn:
      return for_prairielearn(grades);
    case GradeFormat::coderunner:
      return for_coderunner(grades);
  }
  return grades;
}

}  // namespace qdot::api
