#pragma once
// What the description of the service says in words, from the files beside the endpoints and in api/about.

#include <string>

#include "api/json/json.hpp"

namespace qdot::api {

/// What belongs to no single address: tags, and schemas that several answers share.
[[nodiscard]] const Json& shared_description();

/// What is said of each address: {"/v1/energy": {"summary": ..., "answer": "Energies", "schema": ...}}.
[[nodiscard]] const Json& descriptions();

/// The component that describes problems of this status.
[[nodiscard]] std::string problem_response(int status);

}  // namespace qdot::api
