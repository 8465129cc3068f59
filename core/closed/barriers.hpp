#pragma once
// Where the inertia of one coordinate vanishes or has no bound: no motion passes such a place, whatever the
// speed there, and no formula that was found in sin x or x^2 knows of it.

#include <vector>

#include "core/expr/calculus.hpp"

namespace qdot {

/// What divides the inertia, or the inertia divides by, to some power: cos x of m cos^2 x. Sums are among
/// them; what does not depend on x is not.
[[nodiscard]] std::vector<Expression> factors_of_inertia(const Expression& inertia, const Expression& x);

/// Places at which one of them vanishes, by the parameters: of angles those about 0. Others may be missing.
[[nodiscard]] std::vector<Expression> places_of_barriers(const std::vector<Expression>& factors,
                                                         const Expression& x);

}  // namespace qdot
