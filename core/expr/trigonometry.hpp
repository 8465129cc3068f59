#pragma once
// Trigonometric identities on multiplied-out expressions. Each function returns an equal polynomial.

#include <vector>

#include "core/expr/polynomial.hpp"

namespace qdot {

/// Arguments u of the sin(u) and cos(u) in the polynomial, in node order.
[[nodiscard]] std::vector<Expression> trigonometric_arguments(Graph& graph, const Polynomial& polynomial);

/// Joins pairs of terms until none is left that an identity makes one:
/// sin^2 u + cos^2 u = 1, 1 - sin^2 u = cos^2 u, cos u cos v + sin u sin v = cos(u - v),
/// sin u cos v - cos u sin v = sin(u - v) and the like with u + v; cos^2 u - sin^2 u = cos 2u.
[[nodiscard]] Polynomial joined(Graph& graph, Polynomial polynomial);

/// sin^2 u -> 1 - cos^2 u in every term.
[[nodiscard]] Polynomial without_sine_squares(Graph& graph, const Polynomial& polynomial,
                                              const Expression& u);
/// cos^2 u -> 1 - sin^2 u in every term.
[[nodiscard]] Polynomial without_cosine_squares(Graph& graph, const Polynomial& polynomial,
                                                const Expression& u);

/// sin u cos u -> sin(2u)/2, cos^2 u -> (1 + cos 2u)/2, sin^2 u -> (1 - cos 2u)/2.
[[nodiscard]] Polynomial with_double_angle(Graph& graph, const Polynomial& polynomial, const Expression& u);

/// a / b where some way to write the squares in a and b makes it exact.
[[nodiscard]] std::optional<Polynomial> trigonometric_quotient(Graph& graph, const Polynomial& a,
                                                               const Polynomial& b);

/// Functions of sums and integer multiples of angles in terms of the single angles, sin^2 -> 1 - cos^2: a
/// normal form, zero exactly when the polynomial vanishes identically (in independent angles).
[[nodiscard]] Polynomial with_single_angles(Graph& graph, const Polynomial& polynomial);

}  // namespace qdot
