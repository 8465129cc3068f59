#include <algorithm>
#include <array>
#include <atomic>
#include <numeric>

#include "api/answers/asking.hpp"
#include "api/answers/batch/line.hpp"
#include "api/answers/batch/request.hpp"
#include "api/answers/many.hpp"
#include "api/http/address.hpp"
#include "api/json/limits.hpp"
#include "api/json/text.hpp"

namespace qdot::api {
namespace {

constexpr const char* lines_type = "application/x-ndjson";
/// Lines whose answers are made at a time, as many threads do: fewer where answers are long.
constexpr std::size_t fewest_at_a_time = 2, most_at_a_time = 16;
constexpr std::size_t long_answer = 256 * 1024;  ///< bytes

/// As they were sent, without the newlines. The last one need not have any.
std::vector<std::string_view> lines_of(std::string_view text) {
  std::vector<std::string_view> lines;
  while (!text.empty()) {
    const std::size_t end = std::min(text.find('\n'), text.size());
    lines.push_back(text.substr(0, end));
    text.remove_prefix(std::min(end + 1, text.size()));
  }
  return lines;
}

/// A list of requests in JSON, or one request over several lines, where a line each is meant.
bool is_no_batch(const std::vector<std::string_view>& lines) {
  const auto first =
      std::ranges::find_if(lines, [](std::string_view line) { return !trimmed(line).empty(); });
  if (first == lines.end()) return false;
  const std::string_view begin = trimmed(*first);
  const bool is_only = std::all_of(first + 1, lines.end(), [](auto line) { return trimmed(line).empty(); });
  return begin == "{" || begin == "[" || (begin.starts_with('[') && (is_only || !begin.ends_with(']')));
}

/// What is wrong with the whole: its type, its form, its length.
std::optional<Problem> problem_of_body(const Call& call, const std::vector<std::string_view>& lines) {
  if (is_no_batch(lines))
    return invalid_request(
        {Place(Road::body)
             .error(
                 "wrong_type",
                 "A batch is lines, each a whole request on one line, {\"id\": 1, \"modes\": {...}}, without [ ] "
                 "around them and without commas between them: jq -c '.[]' makes lines of a list.")});
  const auto header = call.request.headers.find("content-type");
  const std::string type = header == call.request.headers.end() ? "" : header->second;
  const std::string plain = lower_case(trimmed(std::string_view(type).substr(0, type.find(';'))));
  const bool has_lines =
      plain == lines_type || plain == "application/jsonl" || plain == "application/json-lines";
  if (!has_lines && body_type(type, call.request.body) == BodyType::unsupported)
    return Problem{.kind = ProblemKind::unsupported_media_type,
                   .detail =
                       "The lines of a batch are JSON in UTF-8, Content-Type: application/x-ndjson; this "
                       "one says " +
                       in_quotes(type) + "."};
  if (lines.size() > limits::batch_lines)
    return Problem{.kind = ProblemKind::limit_exceeded,
                   .detail = "The batch has " + std::to_string(lines.size()) + " lines; at most " +
                             std::to_string(limits::batch_lines) +
                             " are answered at once. qdot batch has no "
                             "such limit."};
  return std::nullopt;
}

Problem answers_too_long() {
  return {.kind = ProblemKind::limit_exceeded,
          .detail = "The answers up to this line would be longer than " +
                    std::to_string(limits::batch_answer_bytes) +
                    " bytes together; send this line and those after it as another batch."};
}

/// The answers in order. From the first on that would make them too many bytes together, lines are refused:
/// how many are made at a time changes no answer. What comes after too many bytes is not made at all.
std::string answers_to(const std::vector<std::string_view>& lines, const FieldSet& fields, const Call& call,
                       const Asking& asking) {
  const AskEndpoint ask = [&](const std::string& endpoint, std::string body) {
    return asking.respond(endpoint, std::move(body), call.request.interrupted);
  };
  const AskEndpoint refuse = [](const std::string&, const std::string&) {
    return to_response(answers_too_long(), "/v1/batch");
  };
  std::string text;
  bool is_full = false;
  std::size_t at_a_time = fewest_at_a_time;
  for (std::size_t begin = 0; begin < lines.size();) {
    std::vector<std::string> answers(std::min(at_a_time, lines.size() - begin));
    std::array<std::atomic<std::size_t>, most_at_a_time> sizes{};
    for_each(call.request, answers.size(), [&](std::size_t i) {
      const std::size_t before = std::accumulate(sizes.begin(), sizes.begin() + i, text.size());
      const bool is_behind = is_full || before > limits::batch_answer_bytes;
      answers[i] = answered_line(lines[begin + i], fields, is_behind ? refuse : ask);
      sizes[i] = answers[i].size();
    });
    at_a_time = std::min(2 * at_a_time, most_at_a_time);
    for (std::size_t i = 0; i < answers.size(); ++i) {
      if (answers[i].size() > long_answer) at_a_time = fewest_at_a_time;
      is_full = is_full || (!text.empty() && text.size() + answers[i].size() > limits::batch_answer_bytes);
      text += is_full ? answered_line(lines[begin + i], fields, refuse) : std::exchange(answers[i], {});
    }
    begin += answers.size();
  }
  return text;
}

}  // namespace

Endpoint batch_endpoint(std::span<const Endpoint> asked) {
  static const FieldSet fields = batch_line_fields(asked);
  const auto handler = [asked](const FindSystem& find_system, Models& models) {
    return [asking = Asking(asked, find_system, models)](Call& call) {
      const std::vector<std::string_view> lines = lines_of(call.request.body);
      if (const auto problem = problem_of_body(call, lines))
        return to_response(*problem, call.target.path, call.layout);
      Response response{.content_type = lines_type, .body = answers_to(lines, fields, call, asking)};
      call.timing.lap("solve");
      return response;
    };
  };
  return {.name = "batch",
          .help = "Answer many requests, a line of JSON each",
          .question = {&fields, handler},
          .cost = {.milliseconds = 0.1, .made_of = Cost::MadeOf::lines},
          .roads = Roads::body,
          .example = [](const Scene&, const Json&) { return std::optional<Json>(); },
          .offers = {lines_type},
          .body_type = lines_type,
          .other_names = {"bulk", "many", "multi", "batches"}};
}

}  // namespace qdot::api
