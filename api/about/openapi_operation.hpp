#pragma once
// What can be done at one address, in OpenAPI's words.

#include "api/http/routes.hpp"
#include "api/json/json.hpp"
#include "api/scenes/catalogue.hpp"

namespace qdot::api {

/// Throws Json::exception where the address has no description.
[[nodiscard]] Json openapi_operation(const Route& route, const Catalogue& catalogue);

}  // namespace qdot::api
