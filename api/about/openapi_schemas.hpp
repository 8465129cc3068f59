#pragma once
// The schemas of requests, answers and scenes that the description of the service refers to.

#include "api/json/json.hpp"
#include "api/scenes/catalogue.hpp"

namespace qdot::api {

/// {"Energies": ..., "EnergiesRequest": ..., "Scene": ...}
[[nodiscard]] Json openapi_schemas(const Catalogue& catalogue);

}  // namespace qdot::api
