#pragma once
// Where equilibria appear, vanish or meet as one parameter p moves through a range: all zeros in (x, p) of
// the systems of core/steady/bifurcation_systems.hpp, by interval arithmetic
// (core/numerics/root_isolation.hpp).

#include <functional>
#include <span>
#include <vector>

#include "core/steady/bifurcation_systems.hpp"
#include "core/steady/equilibria.hpp"

namespace qdot {

struct CriticalZero {
  BifurcationSystem::Kind kind{};
  Box x;  ///< of the systems' unknowns; angles in (-pi, pi]
  Interval p;
  bool simple{};  ///< proven to be one simple zero; otherwise a cluster that rounding does not resolve
  bool folds{};   ///< of a meeting: one of both curves folds at the very place
};

/// Whether both may be the same place.
[[nodiscard]] bool overlap(const CriticalZero& a, const CriticalZero& b);
/// Adds one; what may be the same place becomes one that is not simple.
void join(std::vector<CriticalZero>& places, CriticalZero zero);

struct CriticalZeros {
  std::vector<CriticalZero> zeros;
  /// Values of p at which a force vanishes everywhere, ascending; zeros there are left out.
  std::vector<double> degenerate;
  bool complete{true};  ///< false: the search was given up, and some may be missing; clusters are left out
  bool undecided{};     ///< somewhere far out rounding does not tell whether there are any
};

/// Zeros of `which`, systems or growth; those in boxes of (x, p) that are `known` are left out.
[[nodiscard]] CriticalZeros critical_zeros(const Model& model, const SteadyProblem& problem,
                                           const BifurcationSystems& systems,
                                           std::span<const BifurcationSystem> which, const Interval& range,
                                           const std::function<bool(std::span<const Interval>)>& known);

}  // namespace qdot
