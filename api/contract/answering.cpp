#include "api/contract/answering.hpp"

#include "api/json/text.hpp"
#include "api/json/writer.hpp"

namespace qdot::api {
namespace {

/// What a body that curl -d sends, and that is no object, was meant to be.
std::string advice_on_form(std::string_view body) {
  const std::string_view text = trimmed(body);
  if (text.empty())
    return " The body is empty: a request is an object, -d '{\"system\": \"cart_pendulum\"}'.";
  if (text.starts_with('\''))
    return " This body begins with a single quote, which the cmd of Windows does not take away: put the body "
           "in double quotes there, with a backslash before each one inside.";
  if (text.starts_with("%7B")) return " --data-urlencode has encoded the JSON: send it with -d.";
  if (text.find('=') != std::string_view::npos)
    return " Fields of a form go into the address of a GET: curl -G.";
  if (text.ends_with(".json"))
    return " To send a file, write @ before its name: -d @" + printable(text) + ".";
  return " A request is a JSON object, {...}.";
}

Problem unsupported(const std::string& content_type, std::string_view body) {
  std::string detail = "A body is JSON in UTF-8, Content-Type: application/json; this one says " +
                       in_quotes(content_type) + ".";
  const std::size_t first = body.find_first_not_of(" \t\r\n");
  if (first != std::string_view::npos && (body[first] == '[' || body[first] == '"')) {
    detail += " A request is a JSON object, {...}.";
  } else if (content_type.starts_with("application/x-www-form-urlencoded")) {
    detail += advice_on_form(body);
  } else if (content_type.starts_with("multipart/")) {
    detail += " A file is sent with curl --json @request.json.";
  }
  return {.kind = ProblemKind::unsupported_media_type, .detail = std::move(detail)};
}

/// A body that nobody reads is not ignored silently.
Submission submission_of_get(const Call& call) {
  Submission submission = submission_of_query(call.target.query);
  if (!call.request.body.empty()) {
    submission.errors.push_back(
        Place(Road::body)
            .error("not_read",
                   "A GET says everything in its query; send this body with POST: curl -d, without -X GET."));
  }
  return submission;
}

/// The query of a POST.
void add_query(const std::vector<std::pair<std::string, std::string>>& query, Submission& submission) {
  for (const auto& [name, value] : query) {
    const Place place = Place(Road::query).below(name);
    if (name != "format") {
      submission.errors.push_back(
          place.error("unknown_field", "A POST says " + in_quotes(name) + " in its body."));
    } else if (submission.fields.contains(name)) {
      submission.errors.push_back(place.error("duplicate_field", "'format' is given twice in the request."));
    } else {
      submission.fields[name] = value;
    }
  }
}

}  // namespace

Response json_response(const Json& body, Layout layout) {
  return {.status = 200, .content_type = "application/json", .body = to_text(body, layout)};
}

std::variant<Submission, Problem> submission_of(const Call& call, const JsonLimits& bounds) {
  if (call.request.method != "POST") return submission_of_get(call);
  const auto header = call.request.headers.find("content-type");
  const std::string content_type = header == call.request.headers.end() ? "" : header->second;
  if (body_type(content_type, call.request.body) == BodyType::unsupported)
    return unsupported(content_type, call.request.body);
  constexpr JsonLimits of_own_machine{.bytes = limits::answers_bytes, .nodes = limits::answers_bytes};
  const bool is_bounded = call.request.work == Work::bounded;
  auto submission = submission_of_body(call.request.body, is_bounded ? bounds : of_own_machine);
  if (auto* read = std::get_if<Submission>(&submission)) add_query(call.target.query, *read);
  return submission;
}

Handler handler_of(Answering answering) {
  return [answering = std::move(answering)](Call& call) {
    const auto submission = submission_of(call);
    if (const auto* problem = std::get_if<Problem>(&submission)) {
      return to_response(*problem, call.target.path, call.layout);
    }
    return answering(std::get<Submission>(submission), call);
  };
}

}  // namespace qdot::api
