#pragma once
// Cones of a potential: a distance r with r^2 = sum_j a_j (x_j - p_j)^2 over all unknowns x_j has no slope
// where it is 0, at the place p, and a force that has r in it has no value there. With x = p + r n,
//
//   sum_j a_j n_j^2 = 1,   g_i(x) = h_i(x, r)/r,   h_i(p, 0) = 0,
//
// the mean value theorem gives g = C n + f with C_ij = dh_i/dx_j and f_i = dh_i/dr at places between p and x:
// about p forces vanish only for an n = -C^-1 f of length 1. At p itself the force takes any value with n of
// length 1 or less. Where C is positive definite and that n is shorter than 1 it holds the system there;
// where C is negative definite the forces about p push away on every side.
// Source: Clarke, Optimization and Nonsmooth Analysis (1990), 2.2 and 2.3.

#include <span>
#include <vector>

#include "core/compile/compiled_function.hpp"
#include "core/expr/expression.hpp"
#include "core/numerics/box.hpp"

namespace qdot {

/// Functions of the reduction's constants, and of x and r.
struct ConeForms {
  CompiledFunction place;   ///< p_j, then a_j
  CompiledFunction slopes;  ///< C by rows, then f
};

/// Of those `equations` of which there are as many as `unknowns`, in one graph; `x`: all coordinates. Cones
/// that are lines, as where a distance does not depend on all unknowns, are left out.
[[nodiscard]] std::vector<ConeForms> derive_cones(std::span<const Expression> constants,
                                                  std::span<const Expression> x,
                                                  std::span<const Expression> unknowns,
                                                  std::span<const Expression> equations);

enum class AtCone {
  nothing,  ///< no force vanishes there, nor about it
  held,     ///< the forces about it drive back to it from every side
  pushed,   ///< they drive away on every side
  undecided
};

struct Cone {
  Box place;  ///< encloses p; unknowns only
  Box about;  ///< what was looked at: where it is decided, no zero but p is in it
  AtCone what{AtCone::undecided};
};

struct SteadyProblem;
[[nodiscard]] std::vector<Cone> cones_of(const SteadyProblem& problem);

}  // namespace qdot
