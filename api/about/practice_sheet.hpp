#pragma once
// The practice sheet: ten exercises of a course in dynamics (GET /v1/problems calls them problems; in the
// code a Problem is one of RFC 9457). Each part has a question, the one request that answers it, the answer,
// and what the sheet prints. Questions and requests are data (practice_sheet.json); answers are computed when
// they are asked for, and so is whether the sheet agrees with them (agreement.hpp).

#include <functional>
#include <optional>
#include <string_view>

#include "api/http/messages.hpp"
#include "api/json/json.hpp"

namespace qdot::api {

/// The data.
[[nodiscard]] const Json& practice_sheet();

/// Numbers, titles and questions, for GET /v1/problems.
[[nodiscard]] Json exercise_list();

/// One exercise with its answers, for GET /v1/problems/{number}; no value for a number that is none. `answer`
/// is what the service says to a request.
[[nodiscard]] std::optional<Json> answered_exercise(std::string_view number,
                                                    const std::function<Response(const Request&)>& answer);

}  // namespace qdot::api
