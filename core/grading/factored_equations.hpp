#pragma once
// Equations whose sides are products: what solves them, one factor of each at a time.
//
// A product vanishes where one of its factors does, a power where its base does. So n equations in the
// accelerations stand for every choice of one factor from each; where the factors are linear, a choice with a
// determinant that is not zero has one solution. The right motion is that of every choice whose factors all
// vanish on it, and another choice is another solution, which proves the equations wrong.
// (x'' - f)^2 = 0 and theta'' = h say the same as x'' = f and theta'' = h; (x'' - f) x'' = 0 does not.

#include <cstdint>

#include "core/grading/other_solutions.hpp"

namespace qdot {

/// What else solves the equations r = 0, as many as coordinates, all of which the right motion obeys.
/// `everything` where a choice leaves accelerations free, `unknown` where a factor is not linear in the
/// accelerations and may vanish.
[[nodiscard]] OtherSolutionsAnswer other_solutions_of_factors(const ExpectedSystem& system,
                                                              RightMotion& right,
                                                              std::span<const Expression> residuals,
                                                              std::uint64_t seed);

}  // namespace qdot
