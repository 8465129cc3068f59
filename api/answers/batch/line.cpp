#include "api/answers/batch/line.hpp"

#include <algorithm>
#include <new>
#include <stdexcept>
#include <variant>

#include "api/answers/embedded.hpp"
#include "api/contract/json_reader.hpp"
#include "api/contract/request_reader.hpp"
#include "api/http/problem.hpp"
#include "api/json/documents.hpp"
#include "api/json/limits.hpp"
#include "api/json/members.hpp"
#include "api/json/text.hpp"
#include "api/json/writer.hpp"

namespace qdot::api {
namespace {

constexpr std::string_view address = "/v1/batch";
constexpr std::string_view no_id = "null";
constexpr std::size_t around_request = 1024;  ///< bytes and values of a line beside its request
constexpr JsonLimits line_limits{.bytes = limits::large_body_bytes + around_request,
                                 .nodes = limits::large_json_nodes + around_request,
                                 .depth = limits::json_depth + 1};

struct BatchLine {
  std::string id{no_id};  ///< as it was written
  std::string endpoint{};
  std::string_view request{};
};

struct RefusedLine {
  std::string id{no_id};
  Problem problem{};
};

/// An id is what tells lines apart: a number or a short text.
void check_id(const Json& fields, const Place& whole, Errors& errors) {
  const auto id = fields.find("id");
  if (id == fields.end() || id->is_number() || id->is_null()) return;
  const Place place = whole.below("id");
  if (!id->is_string()) {
    report(errors, wrong_type(place, "id", "a number or a text", *id));
  } else if (id->get_ref<const std::string&>().size() > limits::id_bytes) {
    report(errors, place.error("too_long", "'id' has more than " + std::to_string(limits::id_bytes) +
                                               " bytes, the most that a line repeats."));
  }
}

/// The line's members, once its JSON is known to be right.
std::variant<BatchLine, RefusedLine> members_of_line(std::string_view line, Submission submission,
                                                     const FieldSet& fields) {
  std::erase_if(submission.errors, [](const FieldError& duplicate) {  // deeper ones are the request's own
    return std::ranges::count(duplicate.pointer, '/') > 1;
  });
  const Reading reading = read_request(fields, submission, {});
  Errors errors = reading.errors;
  check_id(submission.fields, Place(submission), errors);
  BatchLine read;
  for (auto& [name, text] : members_of(line)) {
    if (name == "id" && text.size() <= 6 * limits::id_bytes && !text.starts_with('{') &&
        !text.starts_with('[')) {
      read.id = text;
    } else if (name != "id") {
      read.endpoint = std::move(name);
      read.request = text;
    }
  }
  if (!errors.empty()) return RefusedLine{read.id, invalid_request(std::move(errors))};
  return read;
}

std::variant<BatchLine, RefusedLine> read_line(std::string_view line, const FieldSet& fields) {
  auto submission = submission_of_body(line, line_limits);
  if (auto* problem = std::get_if<Problem>(&submission)) return RefusedLine{.problem = std::move(*problem)};
  return members_of_line(line, std::get<Submission>(std::move(submission)), fields);
}

std::string written_line(std::string_view id, const Response& response) {
  std::string text = R"({"id":)";
  text.reserve(response.body.size() + id.size() + around_request);
  text.append(id).append(R"(,"status":)").append(std::to_string(response.status)).append(R"(,"answer":)");
  const bool is_json =
      response.content_type.ends_with("json") && !response.content_type.ends_with("x-ndjson");
  if (is_json) {
    text.append(trimmed(std::string_view(response.body).substr(0, response.body.find_last_not_of('\n') + 1)));
  } else {
    append_string(text, response.body);
  }
  return text += "}\n";
}

std::string refused(std::string_view id, const Problem& problem) {
  return written_line(id, to_response(problem, address));
}

/// The name of an endpoint's answer. Its file is long with examples, which every start of the program would
/// read.
std::string answer_of(std::string_view endpoint) {
  for (const auto& [name, text] : members_of(text_of(endpoint_files(), std::string(endpoint) + ".json"))) {
    if (name == "answer") return parse_json(text).get<std::string>();
  }
  throw std::logic_error("no answer is named for " + std::string(endpoint));
}

}  // namespace

std::size_t longest_batch_line() { return line_limits.bytes; }

FieldSet batch_line_fields(std::span<const Endpoint> endpoints) {
  FieldSet set{.description = "One line of a batch."};
  set.fields.push_back({.name = "id",
                        .kind = AnyKind{{{"type", {"number", "string", "null"}}}},
                        .description = "a number or a text that the line's answer repeats"});
  OneOf question{.need = Need::required};
  for (const Endpoint& endpoint : endpoints) {
    const std::string name(endpoint.name);
    set.fields.push_back({.name = name,
                          .kind = AnyKind{{{"$ref", "#/components/schemas/" + answer_of(name) + "Request"}}},
                          .description = "a request of /v1/" + name,
                          .aliases = {endpoint.other_names.begin(), endpoint.other_names.end()}});
    question.ways.push_back({name});
  }
  set.one_of.push_back(std::move(question));
  return set;
}

std::string answered_line(std::string_view line, const FieldSet& fields, const AskEndpoint& ask) {
  const auto read = read_line(line, fields);
  if (const auto* wrong = std::get_if<RefusedLine>(&read)) return refused(wrong->id, wrong->problem);
  const auto& asked = std::get<BatchLine>(read);
  return written_line(asked.id, ask(asked.endpoint, std::string(asked.request)));
}

std::string answer_to_overlong_line() {
  return refused(no_id, {.kind = ProblemKind::payload_too_large,
                         .detail = "The line has more than " + std::to_string(line_limits.bytes) +
                                   " bytes, the most that are read."});
}

std::string id_of_line(std::string_view line, const FieldSet& fields) {
  return std::visit([](const auto& read) { return read.id; }, read_line(line, fields));
}

}  // namespace qdot::api
