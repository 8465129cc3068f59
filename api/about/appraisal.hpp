#pragma once
// What a request will cost, told from its text alone and before it is read properly, so that cheap questions
// need not wait behind dear ones. An appraisal may be wrong by a few times: it decides who waits, and no
// answer. The same request has the same appraisal.

#include <cstddef>
#include <string_view>

#include "api/http/messages.hpp"

namespace qdot::api {

/// `route` is the pattern of the endpoint that will answer.
[[nodiscard]] Appraisal appraise(std::string_view route, const Request& request);

}  // namespace qdot::api
