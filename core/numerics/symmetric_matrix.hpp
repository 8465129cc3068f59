#pragma once
// Eigenvalues of small dense symmetric matrices in 80 bits, by Jacobi's rotations (G. H. Golub, C. F. Van
// Loan, Matrix Computations, 4th ed., section 8.5). Of a symmetric matrix its lower triangle is read.

#include "core/numerics/long_matrix.hpp"

namespace qdot {

/// Values ascending, and columns of what belongs to them.
struct LongAxes {
  LongVector values;
  LongMatrix vectors;
};
/// A v = w v, v.v = 1.
[[nodiscard]] LongAxes symmetric_axes(LongMatrix a);

/// K v = w M v, v.M v = 1, for symmetric K and M. No value where M is not positive definite.
[[nodiscard]] std::optional<LongAxes> principal_axes(const LongMatrix& k, const LongMatrix& m);

}  // namespace qdot
