#pragma once
// Eigenvalues of small dense symmetric matrices in 80 bits, by Jacobi's rotations (G. H. Golub, C. F. Van
// Loan, Matrix Computations, 4th ed., section 8.5). Of a symmetric matrix its lower triangle is read.

#include "core/numerics/long_matrix.hpp"

namespace qdot {

/// Ascending.
[[nodiscard]] LongVector symmetric_eigenvalues(const LongMatrix& a);

/// K v = w M v for symmetric K and M; columns v with v.M v = 1, w ascending. No value where M is not positive
/// definite.
struct LongAxes {
  LongVector values;
  LongMatrix vectors;
};
[[nodiscard]] std::optional<LongAxes> principal_axes(const LongMatrix& k, const LongMatrix& m);

}  // namespace qdot
