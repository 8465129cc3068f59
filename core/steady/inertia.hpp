#pragma once
// Signs of eigenvalues that are proven. Source: Golub, Van Loan, Matrix Computations (4th ed.), 8.1.5
// (Sylvester's law of inertia).

#include <cstddef>
#include <vector>

#include "core/numerics/interval.hpp"

namespace qdot {

/// Signs of the eigenvalues of a symmetric matrix that is only known to lie in these intervals, from the
/// pivots of its elimination (Sylvester). `undecided` counts those that may be zero.
struct Inertia {
  std::size_t positive{}, negative{}, undecided{};
};
[[nodiscard]] Inertia inertia_of(std::vector<Interval> matrix, std::size_t n);

/// Why a potential does not decide beside a mass matrix that is neither positive nor negative definite.
extern const char* const two_signs;

}  // namespace qdot
