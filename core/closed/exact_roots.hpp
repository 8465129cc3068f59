#pragma once
// Formulas of one unknown: roots of c0 + c1 u + c2 u^2, the shortest of equal ones.

#include "core/closed/closed_form.hpp"

namespace qdot {

/// a/b: by identities of angles, or in lowest terms.
[[nodiscard]] Expression shortest_quotient(const Expression& a, const Expression& b, const SignOf& sign);

/// All u with c0 + c1 u + c2 u^2 = 0, both signs of roots among them; c1 or c2 may be zero.
[[nodiscard]] std::vector<Expression> roots_of(const Expression& c0, const Expression& c1,
                                               const Expression& c2, const SignOf& sign);

/// All u with e = 0 where that says that a quadratic polynomial of u, or of u^2, vanishes; a factor u^n is
/// left out, and so are roots of u^2 that are not positive where the symbols have their values.
[[nodiscard]] std::vector<Expression> roots_in(const Expression& e, const Expression& u,
                                               const ExactValues& values);

/// The coefficients of 1, u, u^2 where e = 0 says that such a polynomial vanishes, u^n before it apart.
[[nodiscard]] std::optional<std::vector<Expression>> quadratic_in(const Expression& e, const Expression& u);

}  // namespace qdot
