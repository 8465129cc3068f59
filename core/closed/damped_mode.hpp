#pragma once
// One coordinate that swings with friction, M x'' + D x' + K x = 0 with D^2 < 4 M K:
//
//   x = e^(-rate t) cos(omega t),   rate = D/(2 M),   omega^2 = K/M - rate^2
//
// (Landau, Lifshitz, Mechanics, 3rd ed., section 25), held against the equation at other values of the
// parameters.

#include <optional>

#include "core/closed/exact_mode.hpp"
#include "core/closed/linear_motions.hpp"
#include "core/steady/mode.hpp"

namespace qdot {

struct DampedForms {
  Expression omega, rate;
  ExactMode form;
};

/// No value where the motion is not damped, or does not swing.
[[nodiscard]] std::optional<DampedForms> damped_forms(const LinearMotions& motions, const ExactPlace& place,
                                                      const ExactValues& values);

/// Whether they are the numbers of the mode.
[[nodiscard]] bool agrees(const DampedForms& forms, const Mode& mode, const ExactValues& values);

}  // namespace qdot
