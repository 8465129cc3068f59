#pragma once
// An endpoint is one record. Routes, the GET twin, /openapi.json, /docs, the command line, the appraisal of a
// request and the capabilities of a system all follow from it. To add one, write a folder beside this file,
//
//   energy/request.hpp   the request as a struct, its table, and the declaration of the record
//   energy/request.cpp   the table (api/contract/request_table.hpp): fields with units, defaults and meaning
//   energy/energy.cpp    the answer, and the record
//   energy/energy.json   what OpenAPI says: tag, operation, summary, description, examples, and the name and
//                        schema of the answer
//
// and name the record in questions.cpp; in endpoints.cpp if it is made of other questions.

#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "api/answers/answers.hpp"
#include "api/answers/models.hpp"
#include "api/contract/answering.hpp"
#include "api/contract/request_table.hpp"
#include "api/http/routes.hpp"

namespace qdot::api {

/// What can be asked, and how a request becomes an answer. Where the request of a call is all that is asked,
/// there are also `answering`, the same answer to a submission at hand, such as a row of a sweep, and `read`.
struct Question {
  const FieldSet* fields{};
  std::function<Handler(const FindSystem& find_system, Models& models)> handler{};
  /// The request as the answer echoes it, or what is wrong with it, without an answer.
  std::function<std::variant<Json, Problem>(const Submission&, const FindSystem&)> read{};
  std::function<Answering(const FindSystem& find_system, Models& models)> answering{};
};

/// Makes all of it from one table. What core throws while `answer` runs becomes a problem (guarded).
template <class Request>
Question question(const RequestTable<Request>& table,
                  Response (*answer)(const Resolved<Request>& resolved, Call& call, Models& models)) {
  const auto answers = [&table, answer](const FindSystem& find_system, Models& models) {
    return answering<Request>(table, find_system,
                              [answer, &models](const Resolved<Request>& resolved, Call& call) {
                                return guarded(call, [&] { return answer(resolved, call, models); });
                              });
  };
  const auto handler = [answers](const FindSystem& find_system, Models& models) {
    return handler_of(answers(find_system, models));
  };
  const auto read = [&table](const Submission& submission,
                             const FindSystem& find_system) -> std::variant<Json, Problem> {
    auto read = table.read(submission, find_system);
    if (auto* problem = std::get_if<Problem>(&read)) return std::move(*problem);
    return std::get<Resolved<Request>>(std::move(read)).echo;
  };
  return {&table.set(), handler, read, answers};
}

/// The members of a request beside `system`, for a scene whose parameters have these values; no value where
/// the scene has nothing to ask about.
using Example = std::optional<Json> (*)(const Scene& scene, const Json& parameters);

/// How an endpoint is asked: what does not fit a query line comes in a body only.
enum class Roads { body_and_query, body };

struct Endpoint {
  std::string_view name{};  ///< "energy": the address is /v1/energy, the command `qdot energy`
  std::string_view help{};  ///< one line for `qdot --help`
  Question question{};
  Cost cost{};
  Roads roads{Roads::body_and_query};
  Example example{[](const Scene&, const Json&) { return std::optional(Json::object()); }};
  std::vector<std::string> offers{"application/json"};  ///< media types, the default first
  std::string_view body_type{"application/json"};       ///< of a POST
  std::vector<std::string_view> other_names{};          ///< what people type for it, for "did you mean"
};

/// Where an answer comes in one form alone: ".csv" for text/csv, ".ndjson" for application/x-ndjson. Empty
/// for the default, which the endpoint's own address gives.
[[nodiscard]] std::string suffix_of(const Endpoint& endpoint, std::string_view media_type);

/// Is `word` a name of the endpoint, or one that people type for it?
[[nodiscard]] bool is_called(const Endpoint& endpoint, std::string_view word);

}  // namespace qdot::api
