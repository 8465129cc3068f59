#pragma once
// How long an expression is when it is written out.

#include <cstddef>

namespace qdot {

class Expression;
class Graph;

/// Of the text form of an expression, an expression that occurs twice counted twice.
struct Length {
  /// Additions, multiplications, divisions, powers and calls. A sign and a fraction of two numbers (3/4)
  /// count nothing.
  std::size_t operations{};
  /// Coefficients that are not whole numbers.
  std::size_t fractions{};
};

[[nodiscard]] std::size_t operation_count(const Expression& e);

/// What is compared to find the shorter of two forms: an operation counts two, a coefficient that is not a
/// whole number one.
[[nodiscard]] std::size_t written_length(const Expression& e);

}  // namespace qdot
