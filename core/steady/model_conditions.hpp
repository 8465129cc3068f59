#pragma once
// The scene's conditions `valid_while`, c >= 0, where a state is enclosed: c is known to lie in a ball.
//
// A condition that is exactly 0 at a place, such as the push of a wall against a ladder that stands upright,
// is 0 only to within rounding in doubles, above it or below. Its ball contains zero, which counts as 0: such
// a place is one where the model holds.

#include <span>
#include <vector>

#include "core/dynamics/dynamics.hpp"
#include "core/numerics/ball.hpp"

namespace qdot {

/// One for each condition, at t = 0. `parameters`: at least those of the scene, first. `y` encloses (q, q').
/// Where one has no bound, as by a mass matrix that may be singular, the values in doubles are the middles of
/// all, whose radii are infinite; throws Error(invalid_state) where there is no such value either.
[[nodiscard]] std::vector<Ball> model_conditions(const Dynamics& dynamics, std::span<const Ball> parameters,
                                                 std::span<const Ball> y);

/// Whether no condition is below zero: by its ball, or by its middle where that has no bound.
[[nodiscard]] bool conditions_hold(std::span<const Ball> conditions);

}  // namespace qdot
