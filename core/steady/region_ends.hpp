#pragma once
// Equilibria appear and vanish not only where they meet: as a parameter p moves they may come in from an end
// of the region that is searched, such as from infinity. At an end x_k = e of an unknown that is no angle
//   N_1 = ... = N_n = 0 in the other unknowns and p
// is a square system, whose zeros are where that happens.

#include <string>
#include <vector>

#include "core/steady/bifurcation_systems.hpp"
#include "core/steady/search_region.hpp"

namespace qdot {

struct EndCrossing {
  std::size_t unknown{};  ///< which of the systems' unknowns
  double end{};           ///< e
  Interval p;             ///< not finite where it could not be told
  /// Of one unknown: 1 where the equilibrium is there for larger p, -1 for smaller; 0 where that is not told.
  int side{};
};

[[nodiscard]] std::vector<EndCrossing> end_crossings(const Model& model, const SteadyProblem& problem,
                                                     const BifurcationSystems& systems,
                                                     const Interval& range);

/// Of the coordinate and the parameter with these names. Where the region ends far out, the forces are not
/// yet those at infinity: a number that is nearly 0 in the range of the parameter means 0 there, and no more
/// digits are given than both have in common.
[[nodiscard]] std::string sentence(const EndCrossing& crossing, const std::string& coordinate,
                                   const std::string& parameter, const Interval& range);

}  // namespace qdot
