#pragma once
// Factors that an equation in x and p is a product of, found without factoring: what all its coefficients of
// powers of p have in common (its content: x - 1 of (x - 1)^2 - p (x - 1)), and squares. Source: Geddes,
// Czapor, Labahn, Algorithms for Computer Algebra (1992), 2.7 and 8.2.

#include <vector>

#include "core/expr/expression.hpp"

namespace qdot {

struct Factor {
  Expression base;
  bool is_repeated{};  ///< its square divides the equation
};

/// Each once, none a number; e itself where nothing is found.
[[nodiscard]] std::vector<Factor> factors_along(const Expression& e, const Expression& p);

/// Those, with functions of p for symbols of their own, too, and of each what is linear in one of its symbols
/// (core/expr/linear_factors.hpp), such as curves x = c(p); where there are none, those that only functions
/// of a single angle show: sin u of sin(2 u) - p sin(u).
[[nodiscard]] std::vector<Factor> factors_and_curves(const Expression& e, const Expression& p);

}  // namespace qdot
