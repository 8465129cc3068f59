#pragma once
// What stays constant along every motion, and why (Noether: a symmetry of L is a conserved quantity).

#include <string>
#include <vector>

#include "core/mechanics/lagrangian.hpp"

namespace qdot {

struct ConservedQuantity {
  std::string name;  ///< "energy", "h", "p_psi"
  std::string unit;
  Expression value;  ///< in q, q', t
  std::string why;   ///< one sentence
};

/// Conserved momenta of ignorable coordinates and, when L does not contain the time, the Jacobi integral h,
/// called energy where h = T + V. What is conserved depends on the parameters: without gravity the spring
/// pendulum keeps p_theta, so ask for the Lagrangian with the vanishing parameters replaced by 0.
[[nodiscard]] std::vector<ConservedQuantity> conserved_quantities(const Lagrangian& lagrangian,
                                                                  const Scene& scene);

/// Why the energy T + V is not among the conserved quantities; empty when it is.
[[nodiscard]] std::string why_energy_changes(const Lagrangian& lagrangian);

}  // namespace qdot
