#pragma once
// What an answer says of parameters that are 0 where masses stand: one rule for all that follow
// accelerations.

#include "api/answers/answers.hpp"
#include "api/http/routes.hpp"

namespace qdot::api {

/// Throws Error(invalid_parameters) where something that the scene is written with has no value in any state,
/// as 1/m of a Lagrangian.
void refuse_parts_without_value(const ResolvedSystem& system);

/// Notes coordinates that the limit of an equation moves.
void note_limits(const Scene& scene, const std::vector<std::size_t>& limits, Call& call);

/// Both, by the equations of motion, where accelerations are asked for. Throws Error(invalid_parameters)
/// where none follow from the equations in any state.
void note_lost_inertia(const ResolvedSystem& system, Call& call);

}  // namespace qdot::api
