#pragma once
// Compiled functions for questions about a scene that need no motion: equilibria, steady motions, small
// oscillations and turning points. Each takes the reduction's constants (parameters, then momenta) as
// parameters and the coordinates x that are left as variables; all can be evaluated in doubles or, with
// core/compile/tape_evaluator.hpp, in intervals.

#include <optional>
#include <span>
#include <vector>

#include "core/compile/compiled_function.hpp"
#include "core/mechanics/reduction.hpp"

namespace qdot {

struct Statics {
  Reduction reduction;
  std::vector<Expression> rest;    ///< g_i(x) = E_i(x, 0, 0), simplified: a zero is a steady motion
  CompiledFunction forces;         ///< g, n outputs
  CompiledFunction stiffness;      ///< K_ij = dg_i/dx_j, n x n by rows
  CompiledFunction inertia;        ///< M_ij = dE_i/dx_j'' at rest, n x n by rows
  CompiledFunction damping;        ///< D_ij = dE_i/dx_j' at rest: gyroscopic (skew) and damping (symmetric)
  CompiledFunction ignored_rates;  ///< q_c' at rest
  /// Effective potential U(x) = -R(x, 0) [J], g = dU/dx; only where the reduction is conservative.
  std::optional<CompiledFunction> potential;
  /// Where coordinates are ignored: M, K and D of all N coordinates along the steady motion, each N x N by
  /// rows, M u'' + D u' + K u = 0 for small departures u from it.
  std::optional<CompiledFunction> linearized;
  /// No M_ij contains a velocity: the energy is 1/2 x'.M x' + U, and no motion passes where U exceeds it.
  bool quadratic{};
};

/// Arguments as in derive_reduction. Throws Error(not_applicable) where the time enters the equations:
/// nothing stays at rest then.
[[nodiscard]] Statics derive_statics(const Lagrangian& lagrangian,
                                     const std::vector<Expression>& divided = {});

/// The same of a reduction, without the matrices of all coordinates.
[[nodiscard]] Statics statics_of(Reduction reduction);

/// Expressions of the reduction's graph, or of a copy of it, as one more function of the constants and x.
[[nodiscard]] CompiledFunction compiled_at_rest(const Reduction& reduction, Graph& graph,
                                                std::span<const Expression> expressions);

}  // namespace qdot
