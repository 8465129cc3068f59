#pragma once
// Another root of equations in the accelerations, of whatever form, found at a state and proven there.
//
// Newton's method proposes x; Krawczyk's test proves it: with Y near (dr/dx)^-1 and a box X about x,
//
//   K = x - Y r(x) + (1 - Y dr/dx(X)) (X - x) inside X
//
// means that X holds a root. If X does not hold the right accelerations, the equations allow another motion.
// That none is found proves nothing.
// Source: Neumaier, Interval Methods for Systems of Equations (1990), theorem 5.1.8.

#include <cstdint>

#include "core/grading/other_solutions.hpp"

namespace qdot {

/// `some` with its state, or `unknown`. As many residuals as coordinates, each 0 on the right motion.
[[nodiscard]] OtherSolutionsAnswer proven_other_root(const ExpectedSystem& system, RightMotion& right,
                                                     std::span<const Expression> residuals,
                                                     std::uint64_t seed);

}  // namespace qdot
