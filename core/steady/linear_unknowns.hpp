#pragma once
// Unknowns that an equation gives at once: from s x_j + r = 0, where s is a constant other than 0 and r knows
// nothing of x_j, follows x_j = -r / s, and one equation and one unknown less are left. What is left has the
// same multiple zeros: the determinant of its derivatives times s is that of all (Schur's complement). Of two
// equations their combinations count, too (core/steady/combined_forces.hpp).

#include <span>
#include <vector>

#include "core/expr/expression.hpp"

namespace qdot {

struct LinearUnknowns {
  std::vector<Expression> equations;  ///< that are left
  std::vector<std::size_t> unknowns;  ///< places of the unknowns that are left; one at least
  std::vector<Expression> values;     ///< of all unknowns, by those that are left
};

/// `may_go`: for each unknown whether it may be left out. `constants`: symbols of numbers other than 0. What
/// is put in for an unknown is a sum of products of the others, `parameter`, sines, cosines and exponentials,
/// so that it is finite wherever they are.
[[nodiscard]] LinearUnknowns without_linear_unknowns(std::vector<Expression> equations,
                                                     std::span<const Expression> unknowns,
                                                     const std::vector<bool>& may_go,
                                                     std::span<const Expression> constants,
                                                     const Expression& parameter);

}  // namespace qdot
