#pragma once
// The usual ways to get one term of a formula wrong, tried on the right formula: where a submitted one is the
// right one with such a change, the student is told which slip it was (core/grading/slip_kind.hpp). In the
// equation m l^2 theta'' + m g l sin(theta) = 0, sin(theta) becomes cos(theta), or l^2 becomes l.

#include <optional>
#include <span>
#include <vector>

#include "core/expr/expression.hpp"
#include "core/grading/slip_kind.hpp"

namespace qdot {

struct ChangedTerm {
  Slip slip{};
  Expression change;               ///< what is added to the formula
  std::optional<Expression> term;  ///< what stands in the term's place
};

/// Changes of one term: an exponent, sine for cosine, an argument. `symbols`: what may stand in an argument.
[[nodiscard]] std::vector<ChangedTerm> changes_of_term(const Expression& term,
                                                       std::span<const Expression> symbols);

/// Changes of the whole: small angles, sine for cosine everywhere, gravity turned over.
[[nodiscard]] std::vector<ChangedTerm> changes_of_whole(const Expression& e,
                                                        const std::optional<Expression>& gravity);

/// What the term of an equation may have had of symbols that it has no more: an equation stands divided by
/// what its terms have in common, and F l cos(phi) may be F cos(phi), whose l was forgotten or squared.
[[nodiscard]] std::vector<ChangedTerm> changes_by_cancelled(const Expression& term,
                                                            std::span<const Expression> symbols);

}  // namespace qdot
