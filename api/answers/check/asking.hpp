#pragma once
// Asking the other questions from inside: an item of a check holds a whole request of one of them.

#include <map>
#include <optional>
#include <string>

#include "api/answers/endpoint.hpp"
#include "api/contract/field_values.hpp"

namespace qdot::api {

class Asking {
 public:
  Asking(const FindSystem& find_system, Models& models);

  [[nodiscard]] bool knows(const std::string& question) const { return handlers_.contains(question); }
  [[nodiscard]] std::vector<std::string> names() const;

  /// The answer to a request of `question`. What is wrong with it is reported with its place below `place`.
  [[nodiscard]] std::optional<Json> ask(const std::string& question, const Json& request, const Place& place,
                                        Errors& errors) const;

 private:
  std::map<std::string, Handler> handlers_;
};

}  // namespace qdot::api
