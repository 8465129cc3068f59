#pragma once
// The practice sheet: what each problem asks, part by part, the one request that answers it, the answer, and
// what the sheet prints. Questions and requests are data (api/about/problems.json); answers are computed when
// asked for.

#include <functional>
#include <optional>
#include <string_view>

#include "api/http/messages.hpp"
#include "api/json/json.hpp"

namespace qdot::api {

/// Numbers, titles and questions, for GET /v1/problems.
[[nodiscard]] Json problem_list();

/// One problem with its answers, for GET /v1/problems/{number}; no value for a number that is none. `answer`
/// is what the service says to a request.
[[nodiscard]] std::optional<Json> problem_answers(std::string_view number,
                                                  const std::function<Response(const Request&)>& answer);

}  // namespace qdot::api
