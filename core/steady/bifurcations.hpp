#pragma once
// Critical values of one parameter: where equilibria appear, vanish or meet, all of them in a range
// (core/steady/bifurcation_systems.hpp, core/numerics/root_isolation.hpp), each with a proven bound of its
// error; and the equilibria along the range as curves for a plot. Where forces have no factors but a symmetry
// makes curves meet, as with several coordinates, that search is given up: `complete` is false then, and
// critical values at which a curve changes its stability are found by bisection along it.
//
// Ignorable coordinates keep their momenta while the parameter moves.

#include <span>
#include <string>
#include <vector>

#include "core/steady/equilibria.hpp"

namespace qdot {

enum class BifurcationKind { pitchfork, saddle_node, transcritical };
[[nodiscard]] const char* name(BifurcationKind kind);

struct CriticalValue {
  BifurcationKind kind{};
  double value{};  ///< of the parameter
  double error{};
  std::vector<double> y, errors;  ///< (q, q') there
  /// False: round-off leaves a cluster instead of one proven point; the kind is what the numbers of
  /// equilibria beside it say.
  bool proven{true};
};

/// Equilibria that go over into each other, by ascending parameter.
struct EquilibriumBranch {
  std::vector<double> parameter;
  std::vector<std::vector<double>> x;  ///< the coordinates, in the scene's order
  std::vector<Stability> stability;
};

struct Bifurcations {
  std::vector<CriticalValue> critical;  ///< ascending
  std::vector<EquilibriumBranch> branches;
  bool complete{true};
  std::string reason;  ///< why there are none, or not all
  /// Values at which a force vanishes everywhere, so that its equilibria are not isolated.
  std::vector<double> degenerate;
};

/// Of parameter number `index` in [from, to], from < to, the others as given. Throws as steady_problem.
[[nodiscard]] Bifurcations bifurcations(const Dynamics& dynamics, std::span<const double> parameters,
                                        std::span<const double> y, std::size_t index, double from, double to);

}  // namespace qdot
