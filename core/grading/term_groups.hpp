#pragma once
// Terms of a formula that belong together: the force of a spring, what is quadratic in a rate.

#include <span>
#include <vector>

#include "core/expr/expression.hpp"

namespace qdot {

/// The terms that speak of one symbol, more than one and not all.
struct TermGroup {
  Expression symbol, sum;
  bool has_accelerations{};
  std::size_t count{};
};

/// The smallest first; what is accelerated last, because the sign of the others says the same of it. None of
/// more than 24 terms.
[[nodiscard]] std::vector<TermGroup> groups_of_terms(std::span<const Expression> terms,
                                                     std::span<const Expression> symbols,
                                                     std::span<const Expression> accelerations);

}  // namespace qdot
