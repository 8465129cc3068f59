#pragma once
// How long an expression is when it is written out.

#include <cstddef>

#include "core/expr/expression.hpp"

namespace qdot {

/// Additions, multiplications, divisions, powers and calls in the text form of e. A sign and a fraction of
/// two numbers (3/4) count nothing.
[[nodiscard]] std::size_t operation_count(const Expression& e);

/// What is compared to find the shorter of two forms: an operation counts two, a coefficient that is not a
/// whole number one.
[[nodiscard]] std::size_t written_length(const Expression& e);

}  // namespace qdot
