#pragma once
// Products of powers with one root for each kind: m*g^2*sqrt(q/(m*g))/q is g*sqrt(m*g/q).

#include "core/expr/surd.hpp"

namespace qdot {

/// The same where it is shorter, of a product or a sum of them; what stands under roots is positive.
[[nodiscard]] Expression with_joined_roots(const Expression& e, const SignOf& sign);

}  // namespace qdot
