#pragma once
// Unknowns of a place of rest that stand in sines and cosines (place_search.hpp): a linear or quadratic
// equation of one of them, or of both.

#include "core/closed/exact_place.hpp"

namespace qdot {

/// Settles x_k where the force says what it is; false where it does not.
[[nodiscard]] bool solve_angle(const PlaceProblem& problem, ExactPlace& place, std::size_t k,
                               const Expression& force);

/// Whether the value is that of x_k, among others that are not next to it.
[[nodiscard]] bool is_at(const PlaceProblem& problem, std::size_t k, const Expression& value);

}  // namespace qdot
