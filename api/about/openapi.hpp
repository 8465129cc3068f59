#pragma once
// The description of the service in OpenAPI 3.1, for GET /openapi.json. What can be asked comes from the
// records of the endpoints, with the tables that requests are read by; what is said of each address, and the
// schema of its answer, are data beside the endpoint or in api/about/addresses.

#include "api/http/routes.hpp"
#include "api/json/json.hpp"
#include "api/scenes/catalogue.hpp"

namespace qdot::api {

/// Every route needs its description: throws Json::exception where one is missing.
[[nodiscard]] Json openapi_document(const Routes& routes, const Catalogue& catalogue);

}  // namespace qdot::api
