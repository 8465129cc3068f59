#pragma once
// M x = b where M and b are known within bounds: x for every matrix and right-hand side that they allow.
//
// For a solution x' of the middles, the rest r = b - M x' is enclosed, and the x with M (x - x') = r are
// bounded as in bound_solution() (linear_system.hpp).

#include <span>

#include "core/numerics/ball.hpp"
#include "core/numerics/interval.hpp"

namespace qdot {

/// Replaces each right-hand side by an enclosure of its solutions, M given by rows (n x n), b and x by
/// right-hand sides (k x n); not finite where M may have no inverse.
void solve_linear(std::size_t n, std::span<const Ball> m, std::span<Ball> b) noexcept;

/// The same with intervals; the whole line where M may have no inverse.
void solve_linear(std::size_t n, std::span<const Interval> m, std::span<Interval> b) noexcept;

}  // namespace qdot
