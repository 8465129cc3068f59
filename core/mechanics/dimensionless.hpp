#pragma once
// The dimensionless form of a scene: which combinations of its parameters matter (Buckingham's pi theorem).
//
// As many parameters as there are independent dimensions are taken as units (those the scene's scales are
// made of, else the first that do) and become 1. Any other parameter p becomes p over the product of powers
// of the units that has its dimension; that quotient is a dimensionless group, and L over its unit of energy
// contains the groups alone.

#include <string>
#include <vector>

#include "core/mechanics/lagrangian.hpp"

namespace qdot {

struct DimensionlessGroup {
  std::string name;  ///< "mu", or "<parameter>_hat"
  Expression value;  ///< m/M
};

struct DimensionlessForm {
  std::vector<Expression> units;           ///< the parameters that become 1
  std::vector<DimensionlessGroup> groups;  ///< of all others, in their order
  Expression energy_unit;                  ///< M g l
  Expression time_unit;                    ///< sqrt(l/g)
  Expression lagrangian;                   ///< L over the unit of energy, time in units of time
};

/// In the Lagrangian's graph; `parsed` says what the scales are made of. No value when the scene's parameters
/// do not span its dimensions.
[[nodiscard]] std::optional<DimensionlessForm> dimensionless_form(const Scene& scene,
                                                                  const ParsedScene& parsed,
                                                                  const Lagrangian& lagrangian);

}  // namespace qdot
