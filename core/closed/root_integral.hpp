#pragma once
// Integrals of sqrt(D/N) over w between the two zeros of N, where they are elementary: where D/N is a square
// times 1/Q with a quadratic Q,
//
//   integral P(w) dw / sqrt(-(w^2 + b w + c)),   P a sum of powers w^k, with
//   pi/sqrt(c), pi, -pi b/2, pi (3 b^2 - 4 c)/8  for k = -1, 0, 1, 2,  and pi (-b/2)/c^(3/2) for k = -2,
//
// the former where both zeros are positive. Source: Landau, Lifshitz, Mechanics, 3rd ed., section 11.

#include <optional>
#include <vector>

#include "core/expr/rational_function.hpp"
#include "core/expr/surd.hpp"

namespace qdot {

/// Coefficients of a polynomial of one unknown, by ascending powers.
using Univariate = std::vector<RationalFunction>;

/// Of a polynomial in u; no value where u stands in something that is no power of it.
[[nodiscard]] std::optional<Univariate> univariate(Graph& graph, const Polynomial& e, const Expression& u);

/// Whether one of the following has a value.
[[nodiscard]] bool is_root_integral(const Univariate& above, const Univariate& below);

/// `passes` times the integral of sqrt(below/above), positive; no value where it is none of these. Signs are
/// asked for where squares are taken out of roots.
[[nodiscard]] std::optional<Expression> root_integral(Graph& graph, const Univariate& above,
                                                      const Univariate& below, const SignOf& sign,
                                                      int passes);

/// From w = 0 to the zero of `above`, which is linear or quadratic; `below` is a number.
[[nodiscard]] std::optional<Expression> root_integral_from_zero(Graph& graph, const Univariate& above,
                                                                const Univariate& below, const SignOf& sign,
                                                                int passes);

}  // namespace qdot
