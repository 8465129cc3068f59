#pragma once
// A motion with `precision: extended`: computed in double-doubles from the decimals that were typed, with up
// to 31 digits.
//
// What the motion must not miss, its conditions of validity and the singularities of coordinates, is watched
// by a computation in doubles. Where that computation loses the motion, nobody watches; a motion with such
// conditions is then refused.

#include "api/answers/answers.hpp"
#include "api/answers/simulate/request.hpp"

namespace qdot::api {

/// Throws Error(not_applicable) for a motion that extended precision cannot follow, and why.
[[nodiscard]] Response extended_answer(const SimulateRequest& request, const ResolvedSystem& system,
                                       Call& call);

}  // namespace qdot::api
