#pragma once
// Linear algebra with quotients of polynomials for entries: small and sparse matrices.

#include <vector>

#include "core/expr/rational_function.hpp"

namespace qdot {

using RationalRows = std::vector<std::vector<RationalFunction>>;

/// Rows a of n entries: which unknowns x follow from the others in a x = 0, and how.
struct SolvedRows {
  std::vector<std::size_t> dependent, free;
  RationalRows inverse;  ///< of a's columns `dependent`
  RationalRows allowed;  ///< n x free: a basis of the solutions, each free unknown 1 in turn
};

/// Throws Error(not_applicable) where rows depend on each other.
[[nodiscard]] SolvedRows solved_rows(RationalRows a, std::size_t n);

/// a b, the sizes those of matrices.
[[nodiscard]] RationalRows multiplied(const RationalRows& a, const RationalRows& b);
[[nodiscard]] RationalRows transposed(const RationalRows& a);
/// a + factor b.
[[nodiscard]] RationalRows added(const RationalRows& a, const RationalFunction& factor,
                                 const RationalRows& b);

/// Coefficients of det(s - a) by ascending powers of s (Faddeev, Le Verrier).
[[nodiscard]] std::vector<RationalFunction> characteristic_polynomial(const RationalRows& a);

/// Groups of rows that feed each other: a is block triangular with these blocks, whose eigenvalues it has.
[[nodiscard]] std::vector<std::vector<std::size_t>> blocks_of(const RationalRows& a);

}  // namespace qdot
