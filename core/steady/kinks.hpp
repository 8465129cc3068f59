#pragma once
// Forces with kinks as smooth functions of the coordinates x and of sides s_k = +-1 (core/expr/unfold.hpp).
// At a kink the force takes any value between those of its sides, s_k in [-1, 1]: where one of them vanishes
// is an equilibrium. Source: Clarke, Optimization and Nonsmooth Analysis (1990), 2.2.

#include <span>
#include <vector>

#include "core/compile/compiled_function.hpp"
#include "core/dynamics/statics.hpp"
#include "core/expr/unfold.hpp"

namespace qdot {

/// Functions of the reduction's constants and of (x, s); derivatives along all of (x, s), by rows.
struct SmoothForces {
  std::vector<bool> jumps;             ///< for each kink: some g jumps there, instead of bending only
  CompiledFunction forces;             ///< g
  CompiledFunction stiffness;          ///< dg_i
  CompiledFunction numerators;         ///< of g
  CompiledFunction combinations;       ///< of g (combined_forces.hpp)
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
/// two sides there. `vanishing`: which momenta of the ignored coordinates are zero.
[[nodiscard]] bool has_dry_friction(const Reduction& reduction, const std::vector<bool>& vanishing);

}  // namespace qdot
