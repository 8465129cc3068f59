#pragma once
// Forces with kinks, |u_k| and sign(u_k), as smooth functions of the coordinates x and the sides s_k = +-1 on
// which the place is: |u_k| = s_k u_k, sign(u_k) = s_k. At the kink itself, u_k = 0, the force takes any
// value between those of its sides, s_k in [-1, 1]: where one of them vanishes is an equilibrium. Source:
// Clarke, Optimization and Nonsmooth Analysis (1990), 2.2; Filippov, Differential Equations with
// Discontinuous Righthand Sides (1988), 4.

#include <span>
#include <vector>

#include "core/compile/compiled_function.hpp"
#include "core/dynamics/statics.hpp"

namespace qdot {

/// Expressions without their kinks.
struct Unfolded {
  std::vector<Expression> smooth;
  std::vector<Expression> arguments;  ///< u_k, unfolded, too
  std::vector<Expression> sides;      ///< the symbols s_k
};
/// Of the kinks with one of the variables in them; the others stay.
[[nodiscard]] Unfolded unfolded(std::span<const Expression> expressions,
                                std::span<const Expression> variables);

/// Functions of the reduction's constants and of (x, s); derivatives along all of (x, s), by rows.
struct SmoothForces {
  std::vector<bool> jumps;             ///< for each kink: some g jumps there, instead of bending only
  CompiledFunction forces;             ///< g
  CompiledFunction stiffness;          ///< dg_i
  CompiledFunction numerators;         ///< of g
  CompiledFunction arguments, slopes;  ///< u_k and du_k

  [[nodiscard]] std::size_t kinks() const { return jumps.size(); }
};

/// `rest` are g, in `graph`. Factors of them that cannot vanish are left out: exponentials and `nonzero`,
/// symbols whose domain excludes 0.
[[nodiscard]] SmoothForces derive_smooth_forces(const Reduction& reduction, Graph& graph,
                                                std::span<const Expression> rest,
                                                std::span<const Expression> nonzero);

/// Of `rest` in the statics.
[[nodiscard]] SmoothForces derive_smooth_forces(const Statics& statics);

/// Whether forces at rest depend on the sign of a velocity: dry friction, which takes any value between its
/// two sides there.
[[nodiscard]] bool has_dry_friction(const Reduction& reduction);

}  // namespace qdot
