#pragma once
// Where equilibria appear, vanish or meet as one parameter p moves: the square systems in (x, p) whose zeros
// those places are. Each force is a product of factors, g_i = f_i1 f_i2 ..., and every equilibrium makes one
// factor of each force vanish. Such a family folds where
//   f_1 = ... = f_n = 0,  d = 0,  d a factor of det df/dx      (saddle-node, if d is no repeated one),
// and meets another one where
//   f_ia = f_ib = 0,  f_j = 0 for all j != i     (transcritical, or pitchfork where one of the two folds
//   there).
// All of these are regular zeros where a force without its factors would have a multiple one. Oscillations
// about it begin to grow where
//   f_1 = ... = f_n = 0,  h = 0,  h a factor of the condition in growing_oscillations.hpp.
// Source: Kuznetsov, Elements of Applied Bifurcation Theory (2004), 3.2, 7.1 and 10.2.

#include <vector>

#include "core/steady/reflections.hpp"
#include "core/steady/steady_forces.hpp"

namespace qdot {

/// n + 1 functions of (x, p), x the unknowns that are left, and their (n + 1)^2 derivatives by rows.
struct BifurcationSystem {
  /// degenerate_fold: the determinant has a repeated factor that vanishes there; degenerate_growth: so has
  /// the condition of growth.
  /// pole: a curve of equilibria runs into a place where the forces have no value.
  enum class Kind { fold, degenerate_fold, meeting, growth, degenerate_growth, pole };
  Kind kind{};
  CompiledFunction values, jacobian;
  /// Of a meeting of one unknown: where this is not 0, one of both curves folds at the very place, by its
  /// formula. Without outputs where that is not known.
  CompiledFunction folds{};
};

struct BifurcationSystems {
  /// Those of the forces' unknowns that are left after linear ones (core/steady/linear_unknowns.hpp).
  std::vector<std::size_t> unknowns;
  CompiledFunction values;  ///< all the forces' unknowns at (x, p)
  std::vector<BifurcationSystem> systems;
  /// Of equilibria about which oscillations begin to grow: `systems` knows nothing of them.
  std::vector<BifurcationSystem> growth;
  /// Of curves that run into poles, of one unknown: f = 0 and what a force is divided by.
  std::vector<BifurcationSystem> poles;
  bool growth_is_collision{};  ///< of two frequencies
  /// Too many coordinates, or algebra that grows too large: oscillations may grow, and `growth` is empty.
  bool growth_is_unknown{};
  CompiledFunction square;  ///< omega^2 of the oscillations at (x, p); without outputs where it is not known
  /// Factors of p alone, as functions of p and their slopes: where one vanishes, so does a force everywhere.
  CompiledFunction vanishing, vanishing_slopes;
  bool depends{};  ///< some force depends on p
  /// Of (x, p): where one vanishes, forces have poles, and zeros of their numerators say nothing.
  CompiledFunction denominators;

  /// The numerators N_i of the forces at (x, p), without factors that cannot vanish, and their derivatives
  /// along all of (x, p), by rows.
  CompiledFunction numerators, slopes;
  /// What has the zeros of `numerators`, nested in exponentials (core/steady/exponential_form.hpp) that rise
  /// or fall: for the ends of a region. None without exponentials.
  struct Nested {
    CompiledFunction values, slopes;
  };
  std::vector<Nested> nested;
  CompiledFunction higher;  ///< N_xx, N_xp, N_xxx; only of one unknown
  /// Centres of reflections that turn N into -N, functions of p alone, whatever it is. Of one unknown.
  CompiledFunction centres;
  std::vector<Mirror> mirrors;  ///< of several unknowns
};

/// `place`: which of the reduction's constants p is. Throws Error(not_applicable) for too many systems.
[[nodiscard]] BifurcationSystems derive_bifurcation_systems(const Scene& scene, const Reduction& reduction,
                                                            const SteadyForces& forces, std::size_t place);

}  // namespace qdot
