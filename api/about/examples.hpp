#pragma once
// Requests to show in documents. They are those of the practice sheet, and some that are put together for the
// systems of the catalogue; each is answered with 200.

#include <string>

#include "api/json/json.hpp"
#include "api/scenes/catalogue.hpp"

namespace qdot::api {

/// OpenAPI's "examples" of a request body: {"name": {"summary": ..., "value": ...}}. `more` are requests
/// without their `system`: [{"summary": ..., "body": {"t_end": 10}, "needs": "impact"}]. Each gets the next
/// system of the catalogue whose scene has the member that it needs, if the address asks about a system.
[[nodiscard]] Json request_examples(const std::string& path, const Json& more, const Catalogue& catalogue);

}  // namespace qdot::api
