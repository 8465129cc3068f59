#pragma once
// Polynomials in powers of x - c instead of x, for intervals: (x - c)^6 multiplied out has terms that cancel
// near c in all but their last digits, and more of them the farther c is from 0.

#include <optional>
#include <span>

#include "core/expr/expression.hpp"

namespace qdot {

/// The middle c of the roots of e, a polynomial of the first of the `variables`, where c is a number. None
/// where e is of another form, or where the roots lie farther apart than c is from 0.
[[nodiscard]] std::optional<Expression> middle_of_roots(const Expression& e,
                                                        std::span<const Expression> variables);

/// e in powers of x - c; e itself where it is no polynomial in x.
[[nodiscard]] Expression in_powers_from(const Expression& c, const Expression& e, const Expression& x);

}  // namespace qdot
