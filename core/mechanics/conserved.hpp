#pragma once
// What stays constant along every motion, and why (Noether: a symmetry of L is a conserved quantity).

#include <span>
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

/// Conserved momenta of ignorable coordinates and, when L does not contain the time, the Jacobi integral h, called
/// energy where h = T + V. `vanishing`: parameters whose value is 0, which can make more quantities conserved:
/// without gravity the spring pendulum keeps p_theta.
[[nodiscard]] std::vector<ConservedQuantity> conserved_quantities(const Lagrangian& lagrangian,
                                                                  std::span<const Expression> vanishing,
                                                                  const std::vector<std::string>& units);

/// L and the generalized forces with some parameters 0.
[[nodiscard]] Lagrangian with_vanishing(const Lagrangian& lagrangian, std::span<const Expression> vanishing);

/// Why the energy T + V is not among the conserved quantities; empty when it is.
[[nodiscard]] std::string why_energy_changes(const Lagrangian& lagrangian);

}  // namespace qdot
