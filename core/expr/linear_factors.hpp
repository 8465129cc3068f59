#pragma once
// Factors of polynomials in several symbols that are linear in one of them: x - 1 - r of the product
// (x - 1 - r) (x^2 - r), multiplied out. With numbers in place of all other symbols such a factor has a
// rational root, and from there its coefficients follow, one degree after the other.
// Source: Geddes, Czapor, Labahn, Algorithms for Computer Algebra (1992), 6.2 (Newton's iteration).

#include <optional>

#include "core/expr/polynomial.hpp"

namespace qdot {

/// One factor that is of degree 1 in a symbol of which a has a higher power; a has no repeated factors. None
/// where there is none, or where an exponent is negative or no integer. Throws Error(too_large).
[[nodiscard]] std::optional<Polynomial> linear_factor(const Polynomial& a);

}  // namespace qdot
