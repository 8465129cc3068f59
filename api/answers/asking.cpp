#include "api/answers/asking.hpp"

#include <algorithm>

#include "api/json/documents.hpp"
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

constexpr std::size_t most_kept = 64;
constexpr std::size_t small = 2000;  // values
constexpr std::size_t longest_request = 20'000;

/// Counts the values in `json`, and not many more than `most`.
std::size_t values_in(const Json& json, std::size_t most) {
  std::size_t count = 1;
  if (!json.is_structured()) return count;
  for (const Json& part : json) {
    if (count > most) break;
    count += values_in(part, most - count);
  }
  return count;
}

bool is_small(const Json& json) { return values_in(json, small) <= small; }

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
  Json answer = parse_json_or_discard(response.body);
  if (response.status == 200 && answer.is_object()) return answer;
  if (answer.is_object()) {
    report_below(answer, place, errors);
  } else {
    report(errors, place.error("not_answered", "Ask for the answer as JSON."));
  }
  return std::nullopt;
}

std::shared_ptr<const Json> KeptAnswers::find(const std::string& question, const std::string& request) {
  const std::scoped_lock lock(mutex_);
  const auto found = std::ranges::find_if(kept_, [&](const auto& k) { return k.is_of(question, request); });
  if (found == kept_.end()) return nullptr;
  std::rotate(kept_.begin(), found, found + 1);
  return kept_.front().answer;
}

void KeptAnswers::keep(const KnownAnswer& known) {
  if (known.request.size() > longest_request || !is_small(*known.answer)) return;
  const std::scoped_lock lock(mutex_);
  if (kept_.size() == most_kept) kept_.pop_back();
  kept_.push_front(known);
}

std::shared_ptr<const Json> AskedOnce::ask(const std::string& question, const Json& request,
                                           const Place& place, Errors& errors) {
  const std::string body = to_text(request);
  if (last_.is_of(question, body)) return last_.answer;
  if (auto kept = kept_.find(question, body)) return kept;
  auto answer = asking_.ask(question, request, place, errors);
  if (!answer) return nullptr;
  last_ = {question, body, std::make_shared<const Json>(std::move(*answer))};
  kept_.keep(last_);
  return last_.answer;
}

}  // namespace qdot::api
