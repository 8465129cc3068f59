#pragma once
// /v1/modes: the equilibrium, the matrices of small motions about it, and their modes.
//
// Every mode has its kind, omega (0 where nothing oscillates) and f; the period where it oscillates; `rate`
// [1/s] of a growth e^(rate t) or decay e^(-rate t). `error` bounds the error of omega, or that of the rate
// where nothing oscillates (`rate_error` where both are there). `lambda` is the eigenvalue -s^2 times the
// square of the scene's unit of time. Components of a shape are numbers, or {re, im} where they are not in
// step: u_j(t) = Re(shape_j e^(s t)). `shape_scaled` turns angles into arcs by the scene's scales and is
// given where all coordinates then have one unit.

#include <optional>

#include "api/answers/endpoint.hpp"

namespace qdot::api {

struct ModesRequest {
  SystemChoice system{};  ///< its `equilibrium` says which one; empty: the one downhill of `initial`
  std::optional<int> digits{};
};

[[nodiscard]] const RequestTable<ModesRequest>& modes_table();

[[nodiscard]] Endpoint modes_endpoint();

}  // namespace qdot::api
