#pragma once
// The endpoints that ask one thing about one system, in the order in which documents list them. Other
// endpoints are made of these (api/answers/endpoints.hpp).

#include <span>

#include "api/answers/endpoint.hpp"

namespace qdot::api {

[[nodiscard]] std::span<const Endpoint> questions();

}  // namespace qdot::api
