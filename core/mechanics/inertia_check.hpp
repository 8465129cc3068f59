#pragma once
// Whether the mass matrix determines the accelerations: singular in every state, as that of a Lagrangian
// c*sqrt(x_dot^2 + y_dot^2), it does not. An identity that makes it so holds at states that nobody chose; so
// the matrix is eliminated there in twice the digits of a double, whatever its size.

#include <optional>
#include <vector>

#include "core/expr/linear.hpp"

namespace qdot {

struct InertiaFault {
  /// Those whose equations have no acceleration; none where only the whole matrix is singular.
  std::vector<std::size_t> coordinates;
};

/// No value where the matrix has an inverse in some state, or no value in any that was tried.
[[nodiscard]] std::optional<InertiaFault> inertia_fault(const Matrix& mass_matrix);

}  // namespace qdot
