#pragma once
// Equilibria at many values of a parameter, joined into curves.

#include <functional>
#include <span>
#include <vector>

#include "core/steady/critical_value.hpp"
#include "core/steady/equilibria.hpp"

namespace qdot {

/// Equilibria that go over into each other, by ascending parameter.
struct EquilibriumBranch {
  std::vector<double> parameter;
  std::vector<std::vector<double>> x;  ///< the coordinates, in the scene's order
  std::vector<Stability> stability;
};

/// All equilibria at one value of the parameter.
/// It may move the parameter a little, off a place where they cannot be told apart.
using EquilibriaAt = std::function<std::vector<SteadyState>(double& parameter)>;

/// Where a curve has no value: none goes on from one side of it to the other.
struct CurvePole {
  double parameter{};
  std::size_t coordinate{};
  double x{};
};

/// Between two neighbours of from, the critical values and to, no equilibrium appears or vanishes, so each is
/// the continuation of its nearest; a curve begins or ends only at a critical point, which it includes.
/// `turns`: which of the scene's coordinates are angles modulo a turn.
[[nodiscard]] std::vector<EquilibriumBranch> branches(const EquilibriaAt& equilibria_at, double from,
                                                      double to, std::span<const CriticalValue> critical,
                                                      const std::vector<bool>& turns,
                                                      std::span<const CurvePole> poles = {});

/// Whether a branch's stability changes where no critical value is, and none at which a force vanishes
/// everywhere, as where gyroscopic or damping forces hold what the potential does not.
[[nodiscard]] bool changes_between(std::span<const EquilibriumBranch> branches,
                                   std::span<const CriticalValue> critical,
                                   std::span<const double> degenerate);

}  // namespace qdot
