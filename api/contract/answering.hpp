#pragma once
// From a table to a handler, which answers a POST with a body and its GET twin alike.

#include <functional>
#include <string>
#include <utility>
#include <variant>

#include "api/contract/json_reader.hpp"
#include "api/contract/request_table.hpp"
#include "api/contract/submission.hpp"
#include "api/http/problem.hpp"
#include "api/http/routes.hpp"

namespace qdot::api {

[[nodiscard]] Response json_response(const Json& body, Layout layout);

/// The submission in a call: the query of a GET, or the body of a POST. The query of a POST may only have
/// `format`, which is about the answer and not about the question. `bounds` are those of a service: of work
/// that has none, what fits into memory is read. Problems: unsupported-media-type and those
/// of read_json.
[[nodiscard]] std::variant<Submission, Problem> submission_of(const Call& call,
                                                              const JsonLimits& bounds = {});

/// Answers a submission that came with a call, or was put together for it.
using Answering = std::function<Response(const Submission&, Call&)>;

/// Answers the submission in a call, or says why it is none.
[[nodiscard]] Handler handler_of(Answering answering);

/// Reads a request by its table and answers it, or says what is wrong with it. The table must outlive what is
/// returned.
template <class Request>
Answering answering(const RequestTable<Request>& table, FindSystem find_system,
                    std::function<Response(const Resolved<Request>&, Call&)> answer) {
  return [&table, find_system = std::move(find_system), answer = std::move(answer)](
             const Submission& submission, Call& call) {
    const auto read = table.read(submission, find_system);
    call.timing.lap("parse");
    if (const auto* problem = std::get_if<Problem>(&read)) {
      return to_response(*problem, call.target.path, call.layout);
    }
    const auto& resolved = std::get<Resolved<Request>>(read);
    call.notes = resolved.request.system.notes;
    return answer(resolved, call);
  };
}

}  // namespace qdot::api
