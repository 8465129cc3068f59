#pragma once
// Krawczyk's operator for n equations F(x) = 0 in n unknowns,
//     K(X) = c - Y F(c) + (I - Y J(X)) (X - c),   c in X, Y near J(c)^-1.
// K(X) inside X proves that X holds exactly one zero, and that K(X) holds it; no zero of X is outside K(X).
// Source: Neumaier, Interval Methods for Systems of Equations (1990), 5.1.

#include <cstddef>
#include <functional>
#include <optional>
#include <span>

#include "core/numerics/box.hpp"

namespace qdot {

/// F and its derivatives J_ij = dF_i/dx_j (n x n by rows), enclosed over a box.
struct SquareSystem {
  std::size_t dimension{};
  std::function<void(std::span<const Interval> x, std::span<Interval> values)> values;
  std::function<void(std::span<const Interval> x, std::span<Interval> jacobian)> jacobian;
  /// What else shows that a box with such values holds no zero that is wanted; may be empty.
  std::function<bool(std::span<const Interval> x, std::span<const Interval> values)> excluded{};
};

[[nodiscard]] Box values_over(const SquareSystem& system, const Box& x);

/// K(X); the box itself where the middle's Jacobian has no inverse.
[[nodiscard]] Box krawczyk(const SquareSystem& system, const Box& box);

/// Whether a zero is left once each equation was solved for its own unknown, one after another, where it has
/// a slope: beside a multiple zero K(X) contracts nothing, but most unknowns are functions of the others
/// there. Source: Neumaier (1990), 4.3 (Gauss-Seidel iteration).
[[nodiscard]] bool may_hold_zero(const SquareSystem& system, Box box);

/// Where Newton's iteration comes from c in six steps, a box without width; none where a Jacobian has no
/// inverse.
[[nodiscard]] std::optional<Box> newton(const SquareSystem& system, Box c);

}  // namespace qdot
