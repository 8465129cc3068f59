#pragma once
// Critical values of one parameter: where equilibria appear, vanish or meet, all of them in a range
// (core/steady/bifurcation_systems.hpp, core/numerics/root_isolation.hpp), each with a proven bound of its
// error; and the equilibria along the range as curves for a plot. Where forces have no factors but a symmetry
// makes curves meet, as with several coordinates, that search is given up: `complete` is false then, and
// critical values at which a curve changes its stability are found by bisection along it.
//
// Ignorable coordinates have the momenta of the start for each value of the parameter (followed_momenta.hpp).

#include <span>
#include <string>
#include <vector>

#include "core/steady/branches.hpp"
#include "core/steady/region_ends.hpp"

namespace qdot {

struct Bifurcations {
  std::vector<CriticalValue> critical;  ///< ascending
  std::vector<EquilibriumBranch> branches;
  bool complete{true};
  std::string reason;  ///< why there are none, or not all, and what happens at ends
  /// Values at which a force vanishes everywhere, so that its equilibria are not isolated.
  std::vector<double> degenerate;
  /// Sentences: where equilibria come from an end of a coordinate, such as infinity, or leave there. What is
  /// known does not take from `complete`.
  std::vector<std::string> at_ends;
  std::vector<EndCrossing> crossings;  ///< which these sentences are about
};

/// Of parameter number `index` in [from, to], from < to, the others as given.
/// Throws what steady_problem throws.
[[nodiscard]] Bifurcations bifurcations(const Dynamics& dynamics, const Reals& parameters, const Reals& y,
                                        std::size_t index, double from, double to);

}  // namespace qdot
