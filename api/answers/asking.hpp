#pragma once
// Asking endpoints from inside: an item of a check holds a whole request of one of them, a line of a batch,
// too.

#include <deque>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
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

/// A question with its request as it is asked, and the answer.
struct KnownAnswer {
  std::string question;
  std::string request;
  std::shared_ptr<const Json> answer;

  [[nodiscard]] bool is_of(const std::string& other, const std::string& body) const {
    return question == other && request == body;
  }
};

/// The last small answers, for all threads: the questions of a key are those of every student.
class KeptAnswers {
 public:
  /// Null where it is not among them.
  [[nodiscard]] std::shared_ptr<const Json> find(const std::string& question, const std::string& request);
  /// Keeps it if it is small.
  void keep(const KnownAnswer& known);

 private:
  std::mutex mutex_;
  std::deque<KnownAnswer> kept_;  ///< the last that was asked for first
};

/// Asks what is not known yet. Of large answers the last one is known: items often point into one answer.
class AskedOnce {
 public:
  /// Keeps references to both.
  AskedOnce(const Asking& asking, KeptAnswers& kept) : asking_(asking), kept_(kept) {}

  /// As Asking::ask; null where there is no answer.
  [[nodiscard]] std::shared_ptr<const Json> ask(const std::string& question, const Json& request,
                                                const Place& place, Errors& errors);

 private:
  const Asking& asking_;
  KeptAnswers& kept_;
  KnownAnswer last_;
};

}  // namespace qdot::api
