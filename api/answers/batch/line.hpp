#pragma once
// A line of a batch: {"id": 1, "modes": {...}} asks what POST /v1/modes with that object asks, and its answer
// is the line {"id":1,"status":200,"answer":{...}}, in which the answer has the bytes of that response. Lines
// know nothing of each other: a wrong one is answered by a problem of its own.

#include <functional>
#include <span>
#include <string>
#include <string_view>

#include "api/answers/endpoint.hpp"

namespace qdot::api {

/// The most bytes that a line may have.
[[nodiscard]] std::size_t longest_batch_line();

/// What a line may say: an `id`, and one of the endpoints.
[[nodiscard]] FieldSet batch_line_fields(std::span<const Endpoint> endpoints);

/// How an endpoint is asked with the text of a request.
using AskEndpoint = std::function<Response(const std::string& endpoint, std::string body)>;

/// The line that answers `line`, with its newline.
[[nodiscard]] std::string answered_line(std::string_view line, const FieldSet& fields,
                                        const AskEndpoint& ask);

/// The line that answers one of more than longest_batch_line() bytes, which nobody keeps.
[[nodiscard]] std::string answer_to_overlong_line();

/// The `id` of a line as it is written; "null" where it has none that can be read.
[[nodiscard]] std::string id_of_line(std::string_view line, const FieldSet& fields);

}  // namespace qdot::api
