#pragma once
// The values of a parameter at which oscillations about an equilibrium begin to grow
// (core/steady/growing_oscillations.hpp), all of them in a range.

#include <functional>
#include <optional>
#include <vector>

#include "core/steady/critical_value.hpp"
#include "core/steady/critical_zeros.hpp"

namespace qdot {

struct GrowthZero {
  CriticalZero zero;
  BifurcationKind kind{};         ///< hopf, flutter, or unresolved where pairs cross together or touch
  std::optional<Interval> omega;  ///< of the oscillations, where it is known
};

struct CriticalGrowth {
  std::vector<GrowthZero> zeros;
  bool complete{true};
};

/// Of the constant number `index` in `range`. `place_of`: all x of a zero of the systems.
[[nodiscard]] CriticalGrowth critical_growth(const Dynamics& dynamics, const SteadyProblem& problem,
                                             const BifurcationSystems& systems, std::size_t index,
                                             const Interval& range,
                                             const std::function<Box(const CriticalZero&)>& place_of);

}  // namespace qdot
