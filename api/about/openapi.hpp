#pragma once
// The description of the service in OpenAPI 3.1, for GET /openapi.json. What can be asked comes from the
// tables that requests are read by; what is said of each address, and the schemas of the answers, are data
// (api/openapi/).

#include "api/http/routes.hpp"
#include "api/json/json.hpp"
#include "api/scenes/catalogue.hpp"

namespace qdot::api {

[[nodiscard]] Json openapi_document(const Routes& routes, const Catalogue& catalogue);

}  // namespace qdot::api
