#pragma once
// Where the stability along a curve of equilibria changes, or the sign of det dg/dx does, and the search for
// critical points was given up: the value of the parameter, by bisection along the curve.

#include <span>
#include <vector>

#include "core/steady/branches.hpp"
#include "core/steady/critical_kinds.hpp"
#include "core/steady/critical_problem.hpp"

namespace qdot {

/// Changes along `branches` that are not at one of `known`, with the parameter in `range`. Two more
/// equilibria on one side than on the other, on the mirror of a symmetry, say that one is a pitchfork; all
/// others are unresolved.
[[nodiscard]] std::vector<KnownZero> missed_changes(CriticalProblem& problem, const CriticalChart& chart,
                                                    std::size_t index,
                                                    std::span<const EquilibriumBranch> branches,
                                                    std::span<const CriticalValue> known,
                                                    const Interval& range);

}  // namespace qdot
