#pragma once
// All eigenvalues of a pencil A x = lambda B x with rigorous bounds, also where eigenvectors are nearly
// parallel or missing. In a basis X that splits the space into the invariant subspaces of clusters, and in
// which each cluster is triangular, P = W A X and Q = W B X, W = (B X)^-1; with weights s_i > 0 all
// eigenvalues lie in the discs
//
//   |lambda - v_i| <= r_i = sum_{j != i} |P_ij - v_i Q_ij| s_j/s_i / (|Q_ii| - sum_{j != i} |Q_ij| s_j/s_i),
//
// and k discs that hang together hold k of them (Gershgorin): each of those is known to no better than all
// of the discs. Weights that fall along a cluster of n weigh what is above the diagonal against what rounding
// left below it, and r goes as the n-th root of that.
// Sources: Stewart, Sun, Matrix Perturbation Theory (1990), IV.1, VI.2; Golub, Van Loan, Matrix Computations
// (4th ed.), 7.6, for the reordered and block-diagonalized Schur form.

#include <vector>

#include "core/numerics/eigensystem.hpp"

namespace qdot {

struct EnclosedEigenvalue {
  ComplexBall middle;     ///< of no radius
  double radius{};        ///< of a disc that holds all members; not finite where nothing could be proven
  std::size_t members{};  ///< eigenvalues in the disc
};

/// As many as A has rows; the eigenvalues of one set of discs stand beside each other with one disc.
[[nodiscard]] std::vector<EnclosedEigenvalue> enclose_eigenvalues(const SquareMatrix<ComplexBall>& a,
                                                                  const SquareMatrix<ComplexBall>& b);

}  // namespace qdot
