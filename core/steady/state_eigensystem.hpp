#pragma once
// Eigenvalues and eigenvectors of a real matrix of a first-order system x' = A x, enclosed.

#include "core/numerics/eigensystem.hpp"

namespace qdot {

/// Where eigenvectors are nearly parallel the eigenvalues come by clusters
/// (core/numerics/eigenvalue_clusters.hpp) and the eigenvectors from A - s; radii are not finite where
/// nothing could be proven.
[[nodiscard]] Eigensystem<ComplexBall> state_eigensystem(const SquareMatrix<ComplexBall>& a);

}  // namespace qdot
