#pragma once
// Asking endpoints from inside: an item of a check holds a whole request of one of them, a line of a batch,
// too.

#include <deque>
#include <functional>
#include <map>
#include <optional>
#include <span>
#include <string>

#include "api/answers/endpoint.hpp"
#include "api/contract/field_values.hpp"

namespace qdot::api {

class Asking {
 public:
  Asking(std::span<const Endpoint> endpoints, const FindSystem& find_system, Models& models);

  [[nodiscard]] bool knows(const std::string& question) const { return handlers_.contains(question); }
  [[nodiscard]] std::vector<std::string> names() const;

  /// The response to a POST of `body` to the endpoint `question`, the same as over HTTP.
  [[nodiscard]] Response respond(const std::string& question, std::string body,
                                 const std::function<bool()>& interrupted = {}) const;

  /// The answer to a request of `question`. What is wrong with it is reported with its place below `place`.
  [[nodiscard]] std::optional<Json> ask(const std::string& question, const Json& request, const Place& place,
                                        Errors& errors) const;

 private:
  std::map<std::string, Handler> handlers_;
};

/// The same question is asked once, as long as its answer is small and few others came between: items often
/// point into one answer.
class AskedOnce {
 public:
  explicit AskedOnce(const Asking& asking) : asking_(asking) {}

  /// As Asking::ask; nullptr where there is no answer. What it points to lasts until the next question.
  [[nodiscard]] const Json* ask(const std::string& question, const Json& request, const Place& place,
                                Errors& errors);

 private:
  struct Known {
    std::string question;
    Json request;
    Json answer;
  };

  const Asking& asking_;
  std::deque<Known> known_;  ///< the latest last, which may be large
};

}  // namespace qdot::api
