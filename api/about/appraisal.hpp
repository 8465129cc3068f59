#pragma once
// What a request will cost. It is judged by the text of the request alone, before that is read properly, so
// that cheap questions need not wait behind expensive ones. An appraisal may be wrong by a factor of a few,
// because it decides who waits and changes no answer. The same request always has the same appraisal.

#include "api/http/messages.hpp"
#include "api/http/routes.hpp"

namespace qdot::api {

/// `route` will answer; the appraisal refers to its pattern. Takes less than two milliseconds.
[[nodiscard]] Appraisal appraise(const Route& route, const Request& request);

}  // namespace qdot::api
