#pragma once
// What a system can be asked. It is found out by asking: each endpoint has an example
// (api/answers/endpoint.hpp), and what is answered applies. Nothing here knows why a question does not apply.

#include <functional>

#include "api/http/messages.hpp"
#include "api/json/json.hpp"
#include "api/scenes/catalogue.hpp"

namespace qdot::api {

using Ask = std::function<Response(const Request&)>;

/// "outputs": name and unit of every column that a trajectory can have; "capabilities": the endpoints that
/// apply; "examples": for each of them, a request that is answered with 200. `ask` answers as the service
/// does.
[[nodiscard]] Json capabilities_json(const CatalogueEntry& entry, const Ask& ask);

}  // namespace qdot::api
