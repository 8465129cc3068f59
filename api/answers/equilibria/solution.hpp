#pragma once
// The parameter, or momentum, that makes a position an equilibrium: 'solve_for' and 'at'.

#include <vector>

#include "api/answers/answers.hpp"
#include "api/answers/equilibria/request.hpp"
#include "api/http/problem.hpp"

namespace qdot::api {

/// Puts the position into the state and into the echo. Returns an error for each coordinate that the position
/// lacks although forces depend on it.
[[nodiscard]] std::vector<FieldError> take_position(const Dynamics& dynamics,
                                                    const EquilibriaRequest& request, const Place& root,
                                                    ResolvedState& state, Json& echo);

/// All its values, with their stability and formulas, and the positions for which there is one.
[[nodiscard]] Json solution_body(const Dynamics& dynamics, const ResolvedState& state,
                                 const EquilibriaRequest& request, int digits);

}  // namespace qdot::api
