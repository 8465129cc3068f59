#pragma once
// Values that nobody chose, with which claims of formulas are tried far from those that a request gives.

#include <random>
#include <vector>

#include "core/expr/expression.hpp"
#include "core/mechanics/scene.hpp"

namespace qdot {

/// Between `value`/reach and `value` times reach.
[[nodiscard]] double scaled_value(double value, double reach, const Domain& domain, std::minstd_rand& random);

/// Of the sign that a value has, between a twelfth and twelve where its domain has that.
[[nodiscard]] double far_value(double value, const Domain& domain, std::minstd_rand& random);

/// Of that sign, up to two turns.
[[nodiscard]] double far_angle(double value, const Domain& domain, std::minstd_rand& random);

/// Those of the symbols that stand within a sine, a cosine or a tangent anywhere in their graph: their signs
/// do not tell its.
[[nodiscard]] std::vector<Expression> angles_among(const std::vector<Expression>& symbols);

}  // namespace qdot
