#include <array>

#include "api/answers/check/expectation.hpp"
#include "api/answers/questions.hpp"
#include "api/contract/version.hpp"
#include "api/json/documents.hpp"
#include "api/json/limits.hpp"
#include "core/base/work.hpp"

namespace qdot::api {
namespace {

/// One submission has its own share of work, so that none can take the others'.
Verdict verdict_on(const Grader& grader, const Json& submitted, const std::function<bool()>& interrupted) {
  if (submitted.is_discarded()) return unreadable("There is no answer.");
  if (submitted.is_object() && submitted.size() == 1 && submitted.contains(too_long))
    return unreadable("It is too long, of " + dump_json(submitted[too_long]) + " bytes.");
  try {
    const WorkScope scope(limits::check_algebra, interrupted);
    return grader(submitted);
  } catch (const Error& error) {
    if (error.code() != ErrorCode::too_large) throw;
    return unreadable("The submission is too large to be compared.");
  }
}

Json item_json(const CheckItem& item, const Verdict& verdict, bool reveal) {
  Json json{{"id", item.id}, {"correct", nullptr}, {"score", 0.0}, {"points", item.points}};
  if (verdict.correct) {
    json["correct"] = *verdict.correct;
    json["score"] = *verdict.correct ? item.points : 0.0;
    json["decided_by"] = verdict.decided_by;
  } else {
    json["decided_by"] = nullptr;
  }
  json["understood"] = verdict.understood;
  json["feedback"] = verdict.feedback;
  json["format_errors"] = verdict.format_errors;
  json["diagnosis"] = verdict.diagnosis;
  json["counterexample"] = verdict.counterexample;
  if (reveal) json["expected"] = verdict.expected;
  return json;
}

/// The request without what is expected: an echo must not give the key away.
Json echo_json(const CheckRequest& request) {
  Json items = Json::array();
  for (const CheckItem& item : request.items) items.push_back({{"id", item.id}, {"points", item.points}});
  return {{"items", std::move(items)}, {"seed", request.seed}, {"reveal", request.reveal}};
}

class CheckAnswer {
 public:
  explicit CheckAnswer(const CheckRequest& request) : request_(request) {}

  void add(const CheckItem& item, const Verdict& verdict) {
    const bool has_verdict = verdict.correct.has_value();
    gradable_ = gradable_ && has_verdict;
    most_ += item.points;
    if (verdict.correct.value_or(false)) earned_ += item.points;
    for (const std::string& why : verdict.format_errors)
      format_errors_.push_back({{"id", item.id}, {"message", why}});
    items_.push_back(item_json(item, verdict, request_.reveal));
  }

  [[nodiscard]] Json body() && {
    return {{"service_version", service_version()},
            {"request", echo_json(request_)},
            {"score", most_ > 0 ? earned_ / most_ : 0.0},
            {"points", earned_},
            {"max_points", most_},
            {"gradable", gradable_},
            {"format_errors", std::move(format_errors_)},
            {"items", std::move(items_)}};
  }

 private:
  const CheckRequest& request_;
  bool gradable_{true};
  double earned_{}, most_{};
  Json format_errors_ = Json::array();
  Json items_ = Json::array();
};

/// All graders, or every mistake in what is expected.
std::variant<std::vector<Grader>, Problem> graders_of(const CheckRequest& request,
                                                      const ExpectationScope& scope) {
  std::vector<Grader> graders;
  Errors errors;
  const Place whole(Road::body);
  const Place items = whole.below("items");
  for (std::size_t i = 0; i < request.items.size(); ++i) {
    const Place place = items.below(i);
    if (auto grader = read_expectation(request.items[i], scope, place, errors))
      graders.push_back(std::move(*grader));
  }
  if (!errors.empty()) return invalid_request(std::move(errors));
  return graders;
}

Response answer_check(const CheckRequest& request, Call& call, const ExpectationScope& scope) {
  const auto read = graders_of(request, scope);
  if (const auto* problem = std::get_if<Problem>(&read))
    return to_response(*problem, call.target.path, call.layout);
  const auto& graders = std::get<std::vector<Grader>>(read);
  CheckAnswer answer(request);
  for (std::size_t i = 0; i < graders.size(); ++i) {
    const CheckItem& item = request.items[i];
    answer.add(item, verdict_on(graders[i], item.submitted, call.request.interrupted));
  }
  call.timing.lap("solve");
  return json_response(in_format(std::move(answer).body(), request.format), call.layout);
}

Handler check_handler(const FindSystem& find_system, Models& models) {
  return [asking = Asking(questions(), find_system, models), kept = std::make_shared<KeptAnswers>(),
          find_system, &models](Call& call) {
    const auto submission =
        submission_of(call, {.bytes = limits::large_body_bytes, .nodes = limits::large_json_nodes});
    if (const auto* problem = std::get_if<Problem>(&submission))
      return to_response(*problem, call.target.path, call.layout);
    const auto read = check_table().read(std::get<Submission>(submission), find_system);
    call.timing.lap("parse");
    if (const auto* problem = std::get_if<Problem>(&read))
      return to_response(*problem, call.target.path, call.layout);
    const CheckRequest& request = std::get<Resolved<CheckRequest>>(read).request;
    AskedOnce once(asking, *kept);
    const ExpectationScope scope{
        asking, once, find_system, models, static_cast<std::uint64_t>(request.seed), request.reveal};
    return guarded(call, [&] { return answer_check(request, call, scope); });
  };
}

}  // namespace

Endpoint check_endpoint() {
  return {.name = "check",
          .help = "Grade submitted numbers, equations and trajectories",
          .question = {&check_table().set(), check_handler},
          .cost = {.milliseconds = 3, .made_of = Cost::MadeOf::items},
          .roads = Roads::body,
          .example = [](const Scene&, const Json&) { return std::optional<Json>(); }};
}

}  // namespace qdot::api
