#pragma once
// The values of a parameter at which oscillations about an equilibrium begin to grow
// (core/steady/growing_oscillations.hpp), all of them in a range.

#include <functional>
#include <vector>

#include "core/steady/critical_kinds.hpp"

namespace qdot {

struct CriticalGrowth {
  std::vector<KnownZero> zeros;  ///< hopf, flutter, or unresolved where pairs cross together or touch
  bool complete{true};
};

/// Of the constant number `index` in `range`. `place_of`: all x of a zero of the systems.
[[nodiscard]] CriticalGrowth critical_growth(const Dynamics& dynamics, const SteadyProblem& problem,
                                             const BifurcationSystems& systems, std::size_t index,
                                             const Interval& range,
                                             const std::function<Box(const CriticalZero&)>& place_of);

}  // namespace qdot
