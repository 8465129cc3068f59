#include "api/answers/asking.hpp"

#include "api/json/pointer.hpp"
#include "api/json/writer.hpp"

namespace qdot::api {
namespace {

/// The errors of a problem, each at its place inside the whole.
void report_below(const Json& problem, const Place& place, Errors& errors) {
  const FieldError here = place.error("", "");
  if (!problem.contains("errors")) {
    report(errors, place.error("not_answered", problem.value("detail", "It has no answer.")));
    return;
  }
  for (const Json& error : problem["errors"]) {
    FieldError below = here;
    below.pointer += error.value("pointer", "#").substr(root_pointer.size());
    below.code = error.value("code", "");
    below.detail = error.value("detail", "");
    below.did_you_mean = error.value("did_you_mean", "");
    below.allowed = error.value("allowed", std::vector<std::string>());
    report(errors, std::move(below));
  }
}

}  // namespace

Asking::Asking(std::span<const Endpoint> endpoints, const FindSystem& find_system, Models& models) {
  for (const Endpoint& endpoint : endpoints) {
    handlers_[std::string(endpoint.name)] = endpoint.question.handler(find_system, models);
  }
}

std::vector<std::string> Asking::names() const {
  std::vector<std::string> names;
  for (const auto& [name, handler] : handlers_) names.push_back(name);
  return names;
}

Response Asking::respond(const std::string& question, std::string body,
                         const std::function<bool()>& interrupted) const {
  const Request inner{.method = "POST",
                      .target = "/v1/" + question,
                      .headers = {{"content-type", "application/json"}},
                      .body = std::move(body),
                      .interrupted = interrupted};
  Call call{.request = inner, .target = {.path = inner.target, .query = {}}};
  call.accepted = "application/json";
  return handlers_.at(question)(call);
}

std::optional<Json> Asking::ask(const std::string& question, const Json& request, const Place& place,
                                Errors& errors) const {
  const Response response = respond(question, to_text(request));
  Json answer = Json::parse(response.body, nullptr, false);
  if (response.status == 200 && answer.is_object()) return answer;
  if (answer.is_object()) {
    report_below(answer, place, errors);
  } else {
    report(errors, place.error("not_answered", "Ask for the answer as JSON."));
  }
  return std::nullopt;
}

const Json* AskedOnce::ask(const std::string& question, const Json& request, const Place& place,
                           Errors& errors) {
  const bool is_known = answer_ && question_ == question && request_ == request;
  if (!is_known) {
    answer_ = asking_.ask(question, request, place, errors);
    question_ = question;
    request_ = request;
  }
  return answer_ ? &*answer_ : nullptr;
}

}  // namespace qdot::api
