#pragma once
// Whether the practice sheet agrees with an answer. What the sheet prints is data: where the answer has it,
// and the sheet's value in the notation of requests,
//
//   [{"at": "/T", "value": "1/2*m*l^2*theta_dot^2"}, {"at": "/theta_max", "value": "0.9622"}].
//
// All of them have to agree, each by the rule for what the answer has there:
//   a number      is the printed decimal, to half a unit of its last digit; or the value of the printed
//   expression
//                 with the request's parameters, to 1e-9 of itself; or it satisfies the printed equation in
//                 its own name to 1e-9 of the largest side
//   an expression has the printed one's value, to 1e-9 of itself, for several values of all symbols
//   an equation   is the printed one times a factor that is free of accelerations: for several states, the
//   ratio of
//                 the two residuals (left - right) is the same, to 1e-9, whatever the accelerations
//   names         of a list, or of an object's members, are the printed ones in their order

#include "api/json/json.hpp"

namespace qdot::api {

/// Throws Error or Json::exception where `prints` cannot be read or points to nothing in the answer.
[[nodiscard]] bool agrees(const Json& prints, const Json& answer);

}  // namespace qdot::api
