#pragma once
// Linear systems as one solves them by hand: an unknown that some equation has with a number or a product of
// symbols in front is expressed by the others, and put into the other equations.

#include "core/expr/linear.hpp"

namespace qdot {

/// x with m x = b, each in short form. Where no unknown can be expressed so any more, Cramer's rule gives the
/// rest; empty where these are more than largest_written_system. Symbols that are divided by are assumed not
/// to be zero.
[[nodiscard]] std::vector<Expression> solved_by_substitution(Matrix m, std::vector<Expression> b);

}  // namespace qdot
