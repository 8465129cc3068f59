#pragma once
// Cones and poles of a potential: a distance r with r^2 = sum_j a_j (x_j - p_j)^2 over all unknowns x_j has
// no slope where it is 0, at the place p, and a force that has r in it has no value there. With x = p + r n,
//
//   sum_j a_j n_j^2 = 1,   g_i(x) = h_i(x, r)/r,   h_i(p, 0) = 0,
//
// the mean value theorem gives g = C n + f with C_ij = dh_i/dx_j and f_i = dh_i/dr at places between p and x:
// about p forces vanish only for an n = -C^-1 f of length 1. At p itself the force takes any value with n of
// length 1 or less. Where C is positive definite and that n is shorter than 1 it holds the system there;
// where C is negative definite the forces about p push away on every side. Where forces have 1/r^3 in them,
// of a potential with 1/r, h_i = r^3 g_i is looked at instead: an n shorter than 1 tells that they vanish
// nowhere about such a pole, at which they have no value. Source: Clarke, Optimization and Nonsmooth Analysis
// (1990), 2.2 and 2.3.

#include <vector>

#include "core/numerics/box.hpp"
#include "core/steady/steady_forces.hpp"

namespace qdot {

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

/// All of the forces.
[[nodiscard]] std::vector<Cone> cones_of(const SteadyProblem& problem);

}  // namespace qdot
