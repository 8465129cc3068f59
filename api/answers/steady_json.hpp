#pragma once
// Equilibria as JSON, for the endpoints whose answers have them.

#include <string>
#include <vector>

#include "api/answers/answers.hpp"
#include "api/answers/models.hpp"
#include "api/json/json.hpp"
#include "core/steady/equilibria.hpp"

namespace qdot::api {

/// Puts `stability`, `eigenvalues`, `rate2` with its error and, where undecided, `nonlinear` into `json`.
void put_stability(Json& json, const SteadyStability& stability, int digits);

/// Units of the state's components, and of the numbers that put_stability puts.
[[nodiscard]] Json steady_units(const Scene& scene);

/// Says of each rate that the request, or the scene that it brings, gives the start, and that no place of
/// rest or steady motion has, that it is left out. The rates of ignorable coordinates count, and those that
/// their momenta depend on.
[[nodiscard]] std::vector<std::string> notes_on_rates(const Dynamics& dynamics, const SystemChoice& choice,
                                                      const ResolvedState& state);

}  // namespace qdot::api
