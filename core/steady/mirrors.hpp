#pragma once
// Mirrors of forces of several unknowns: reflections that leave what vanishes as it is. What folds on a
// mirror folds across it, so that a fold and a crossing of curves there are a pitchfork (Golubitsky,
// Schaeffer, Singularities and Groups in Bifurcation Theory I, 1985, VI.2).

#include "core/steady/critical_zeros.hpp"

namespace qdot {

/// The zero lies on a mirror, along which the equilibrium is regular.
[[nodiscard]] bool is_on_mirror(const SteadyProblem& problem, const BifurcationSystems& systems,
                                const CriticalZero& here);

}  // namespace qdot
