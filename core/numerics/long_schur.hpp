#pragma once
// Eigenvalues of small dense real matrices in 80 bits, by Francis' steps (G. H. Golub, C. F. Van Loan, Matrix
// Computations, 4th ed., section 7.5).

#include "core/numerics/long_matrix.hpp"

namespace qdot {

/// A = Q T Q^H, T upper triangular with the eigenvalues on its diagonal.
struct LongSchur {
  LongComplexMatrix t, q;

  /// The directions k and k + 1 become (c, s) and (-s*, c*) of them; of length 1 if |c|^2 + |s|^2 = 1.
  void turn(Eigen::Index k, const LongComplex& c, const LongComplex& s);
};
/// Conjugate eigenvalues are exactly so, and beside each other. No value where the iteration fails.
[[nodiscard]] std::optional<LongSchur> schur_form(const LongMatrix& a);

/// Not numbers where the iteration fails.
[[nodiscard]] LongComplexVector eigenvalues(const LongMatrix& a);

/// A R = R diag(values); columns of R have length 1, and are real where values are. Where the iteration
/// fails, the unit matrix for R and no numbers.
struct LongEigenvectors {
  LongComplexVector values;
  LongComplexMatrix columns;
};
[[nodiscard]] LongEigenvectors eigenvectors(const LongMatrix& a);

}  // namespace qdot
