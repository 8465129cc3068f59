#pragma once
// Places x where e(x) = 0 says that a quadratic polynomial of one function of x vanishes, or that a power of
// x is known: the turning points of V exp(-x/a), of Morse's potential, of b x^6, of tan(s x)^2.

#include <vector>

#include "core/closed/exact_values.hpp"

namespace qdot {

/// Candidates: each has to be held against the number.
[[nodiscard]] std::vector<Expression> inverted_roots(const Expression& e, const Expression& x,
                                                     const ExactValues& values);

}  // namespace qdot
