#pragma once
// Requests to show, and to be executed by whoever doubts: those of the practice sheet, and some that are put
// together for the systems of the catalogue.

#include <string>

#include "api/json/json.hpp"
#include "api/scenes/catalogue.hpp"

namespace qdot::api {

/// OpenAPI's "examples" of a request body: {"name": {"summary": ..., "value": ...}}. `more` has the rest of
/// requests, [{"summary": ..., "body": {"t_end": 10}, "needs": "impact"}], each for a system that has what
/// it needs.
[[nodiscard]] Json request_examples(const std::string& path, const Json& more, const Catalogue& catalogue);

}  // namespace qdot::api
