#pragma once
// Rest: whether it lasts. Where U is smooth an equilibrium is a zero of g = U'; at a kink it is a place where
// the slopes on both sides have 0 between them.

#include <optional>
#include <string>

#include "core/turning/energy_balance.hpp"

namespace qdot {

/// Whether the force at the number x0 has a sign, but for where x0 is next to a stable equilibrium: beside
/// that the motion stays within the errors.
[[nodiscard]] bool departs_from_rest(EnergyBalance& energy);

struct RestingPlace {
  double error{};         ///< an equilibrium is so near to x0
  std::string stability;  ///< "stable", "unstable" or "neutral"
};

/// The equilibrium at x0. No value where none can be proven.
[[nodiscard]] std::optional<RestingPlace> resting_place(EnergyBalance& energy);

}  // namespace qdot
