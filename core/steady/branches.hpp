#pragma once
// Equilibria at many values of a parameter, joined into curves.

#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "core/steady/critical_value.hpp"
#include "core/steady/equilibria.hpp"
#include "core/steady/region_ends.hpp"

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
/// The same between two others, for a closer look; none where they are not all found.
using EquilibriaBetween = std::function<std::optional<std::vector<SteadyState>>(double parameter)>;

/// Where a curve has no value: none goes on from one side of it to the other.
struct CurvePole {
  double parameter{};
  std::size_t coordinate{};
  double x{};
};

/// Of a scene in which one coordinate tells equilibria apart, and all critical values are known.
struct OneCoordinate {
  std::size_t index{};
  std::vector<double> elsewhere;  ///< values at which curves come or go otherwise than at critical points
};

/// What is known of curves before they are followed.
struct KnownOfCurves {
  std::span<const CriticalValue> critical;
  std::vector<bool> turns;  ///< which of the scene's coordinates are angles modulo a turn
  std::span<const CurvePole> poles;
  std::optional<OneCoordinate> one;
  std::span<const EndCrossing> crossings;  ///< of its region's ends
};

/// Between two neighbours of from, the critical values and to, no equilibrium appears or vanishes: a curve
/// begins or ends only at a critical point, which it includes. Of one coordinate the order tells which
/// equilibrium goes on as which (ordered_continuation.hpp); of several each goes on as its nearest, which is
/// looked at more closely where stable ones and unstable ones would change places.
[[nodiscard]] std::vector<EquilibriumBranch> branches(const EquilibriaAt& equilibria_at,
                                                      const EquilibriaBetween& between, double from,
                                                      double to, const KnownOfCurves& known);

/// Whether something is known to happen at a value of [low, high]: equilibria meet, or come or go elsewhere.
[[nodiscard]] bool is_known_between(double low, double high, std::span<const CriticalValue> critical,
                                    std::span<const double> elsewhere);

/// Whether a branch's stability changes where no critical value is, and none at which a force vanishes
/// everywhere, as where gyroscopic or damping forces hold what the potential does not.
[[nodiscard]] bool changes_between(std::span<const EquilibriumBranch> branches,
                                   std::span<const CriticalValue> critical,
                                   std::span<const double> degenerate);

}  // namespace qdot
