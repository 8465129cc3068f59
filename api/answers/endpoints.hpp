#pragma once
// All endpoints there are (api/answers/endpoint.hpp), in the order in which documents list them.

#include <span>
#include <string>
#include <string_view>

#include "api/answers/endpoint.hpp"
#include "api/json/json.hpp"

namespace qdot::api {

[[nodiscard]] std::span<const Endpoint> endpoints();

/// "/v1/energy"
[[nodiscard]] std::string address_of(const Endpoint& endpoint);

/// The endpoint at an address; nullptr where none is.
[[nodiscard]] const Endpoint* endpoint_at(std::string_view address);

/// Whether its request has a system, so that its answer begins with it.
[[nodiscard]] bool asks_about_a_system(const Endpoint& endpoint);

/// What is said of an endpoint: <name>/<name>.json.
[[nodiscard]] Json description_of(const Endpoint& endpoint);

}  // namespace qdot::api
