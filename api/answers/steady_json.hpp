#pragma once
// Equilibria as JSON, for the endpoints that speak of them.

#include "api/json/json.hpp"
#include "core/steady/equilibria.hpp"

namespace qdot::api {

/// Puts `stability`, `eigenvalues`, `rate2` with its error and, where undecided, `nonlinear` into `json`.
void put_stability(Json& json, const SteadyStability& stability, int digits);

/// What is added to an error by writing the value with so many digits.
[[nodiscard]] Json written_error(double value, double error, int digits);

/// Units of the state's components, and of the numbers that put_stability puts.
[[nodiscard]] Json steady_units(const Scene& scene);

}  // namespace qdot::api
