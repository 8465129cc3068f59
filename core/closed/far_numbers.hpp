#pragma once
// Random values with which a claimed formula is tried, far from the values that a request gives: a formula
// that is right only near those shows it here. Every value lies in its symbol's domain and is drawn from a
// generator that the caller has seeded, so that the same claim is tried with the same values.

#include <random>
#include <vector>

#include "core/expr/expression.hpp"
#include "core/mechanics/scene.hpp"

namespace qdot {

/// `value` reach^r with r evenly between -1 and 1; `value` itself where the domain does not have that.
[[nodiscard]] double scaled_value(double value, double reach, const Domain& domain, std::minstd_rand& random);

/// Of the sign of `value`, 12^r with r evenly between -1 and 1; where its domain does not have that, another
/// place of the domain of the same sign. 0 stays 0.
[[nodiscard]] double far_value(double value, const Domain& domain, std::minstd_rand& random);

/// Of the sign of `value`, evenly up to two turns; `value` itself where the domain does not have that.
[[nodiscard]] double far_angle(double value, const Domain& domain, std::minstd_rand& random);

/// Those of the symbols that stand within a sine, a cosine or a tangent anywhere in their graph: their signs
/// do not tell its.
[[nodiscard]] std::vector<Expression> angles_among(const std::vector<Expression>& symbols);

}  // namespace qdot
