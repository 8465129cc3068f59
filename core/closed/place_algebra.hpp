#pragma once
// The algebra of a place of rest: equations that one power of an unknown solves, and roots.

#include <optional>

#include "core/expr/polynomial.hpp"
#include "core/expr/surd.hpp"
#include "core/steady/exponential_form.hpp"

namespace qdot {

/// e = slope * u^n + rest, rest and slope without the symbol; no value where it is no such function.
struct LinearIn {
  Polynomial slope, rest;
};
[[nodiscard]] std::optional<LinearIn> linear_in(Graph& graph, const Polynomial& e, const Expression& u,
                                                const Expression& symbol, int n = 1);

[[nodiscard]] int highest_power(const Polynomial& e, const Expression& u);

/// Without the factors u, which do not vanish.
[[nodiscard]] Polynomial without_factor(const Polynomial& e, const Expression& u);

/// u where f is tan(u), of one product over another.
[[nodiscard]] std::optional<Expression> angle_of_tangent(Graph& graph, const RationalFunction& f);

/// f with what all its terms share in front, and sin(u)/cos(u) as tan(u): tan(al)*(M - m)/(M + m).
[[nodiscard]] Expression factored_tangent(Graph& graph, const RationalFunction& f);

/// With sin(u)/cos(u) for tan(u).
[[nodiscard]] Expression with_tangents_written(const Expression& e);

/// With roots of squares taken, sqrt(h^2) = h where h > 0.
[[nodiscard]] Expression with_roots_taken(const Expression& e, const SignOf& sign);

/// With |u| = u and sign(u) = 1 where u > 0, and their opposites where u < 0.
[[nodiscard]] Expression with_sizes_taken(const Expression& e, const SignOf& sign);

/// With exp(n log(u)) = u^n and log(exp(u)) = u.
[[nodiscard]] Expression with_logarithms_taken(const Expression& e);

/// As a polynomial in w^n where the powers of w are n apart: in exp(2 a x) of 1/cosh(a x)^2. The lowest power
/// is left out.
[[nodiscard]] ByExponential in_powers_apart(const ByExponential& f);

/// f^(1/n) where f is a product of what is positive, sums among it.
[[nodiscard]] std::optional<Expression> root_of_product(Graph& graph, const RationalFunction& f, int n,
                                                        const SignOf& sign);

}  // namespace qdot
