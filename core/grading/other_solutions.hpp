#pragma once
// Whether an equation that the right motion obeys allows other motions, too.
//
// The equations of the other coordinates leave one direction free for the accelerations: q'' = a + s d, where
// a are the right ones and M d = e_i. On it the equation is phi(s) = r(a + s d) = 0, and it says the same as
// the right equation of coordinate i where phi vanishes at s = 0 only. A linear one has phi = c s; others are
// looked at where phi is a polynomial: phi = s^k (c_k + c_(k+1) s + ...), and the bracket must have no real
// root. So (q'' - f)^2 = 0 says the same as q'' = f, and q''^2 = f^2 does not.

#include <cstdint>

#include "core/grading/right_motion.hpp"

namespace qdot {

enum class OtherSolutions {
  none,
  some,        ///< at the state that is given
  everything,  ///< phi vanishes: it leaves the coordinate free
  unknown      ///< phi is no polynomial of low degree, or too little could be seen
};

struct OtherSolutionsAnswer {
  OtherSolutions found{OtherSolutions::unknown};
  State state{};
};

/// `residual` vanishes on the right motion.
[[nodiscard]] OtherSolutionsAnswer other_solutions(const ExpectedSystem& system, RightMotion& right,
                                                   const Expression& residual, std::size_t coordinate,
                                                   std::uint64_t seed);

}  // namespace qdot
