#pragma once
// Equilibria as JSON, for the endpoints whose answers have them.

#include "api/json/json.hpp"
#include "core/steady/equilibria.hpp"

namespace qdot::api {

/// Puts `stability`, `eigenvalues`, `rate2` with its error and, where undecided, `nonlinear` into `json`.
void put_stability(Json& json, const SteadyStability& stability, int digits);

/// Units of the state's components, and of the numbers that put_stability puts.
[[nodiscard]] Json steady_units(const Scene& scene);

}  // namespace qdot::api
