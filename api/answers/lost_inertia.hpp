#pragma once
// What an answer says of parameters that are 0 where masses stand: one rule for all that follow
// accelerations.

#include <optional>

#include "api/answers/answers.hpp"
#include "api/http/routes.hpp"

namespace qdot::api {

/// Throws Error(invalid_parameters) where something that the scene is written with has no value in any state,
/// as 1/m of a Lagrangian.
/// Parts with the parameter number `varied` may have one.
void refuse_parts_without_value(const ResolvedSystem& system, std::optional<std::size_t> varied = {});

/// Notes coordinates that the limit of an equation moves, or of which it says only where forces vanish.
enum class Limit { moves, has_no_mass };
void note_limits(const Scene& scene, const std::vector<std::size_t>& limits, Limit limit, Call& call);

/// Both, by the equations of motion, where accelerations are asked for. Throws Error(invalid_parameters)
/// where none follow from the equations in any state, whatever the parameter number `varied` is.
void note_lost_inertia(const ResolvedSystem& system, Call& call, std::optional<std::size_t> varied = {});

}  // namespace qdot::api
