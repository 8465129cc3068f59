#pragma once
// Whether the practice sheet agrees with an answer. What the sheet prints is data: where the answer has it,
// and the sheet's value in the notation of requests,
//
//   [{"at": "/T", "value": "1/2*m*l^2*theta_dot^2"}, {"at": "/theta_max", "value": "0.9622"}].
//
// All of these have to agree. The rule depends on what the answer has at the place:
//
//   number      It rounds to the printed decimal (half a unit of the last digit); or it is the value of the
//               printed expression with the request's parameters, to 1e-9 of itself; or it solves the
//               printed equation in its own name, to 1e-9 of the larger side or of 1.
//   expression  It has the value of the printed one, to 1e-9 of itself, at several states.
//   equation    It is the printed one times a factor without accelerations: in each of several states the
//               two residuals (left - right) have the same ratio for all accelerations, to 1e-9.
//   names       Those of a list, or of an object's members, are the printed ones in their order.

#include "api/json/json.hpp"

namespace qdot::api {

/// Throws Error or Json::exception where `prints` cannot be read or points to nothing in the answer.
[[nodiscard]] bool agrees(const Json& prints, const Json& answer);

}  // namespace qdot::api
