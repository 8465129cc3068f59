#pragma once
// How large the terms of the right equations are at a state, as they stand in one that was submitted: with c
// M = dr/dq'',
//
//   sum |c_i| (sum |terms of f_i| + sum |M_ij q_j''|),
//
// and with constraints the same of S u = r (expected_system.hpp).
//
// What vanishes identically has no part in it, so that nobody can make room for a mistake by adding some.

#include "core/grading/right_motion.hpp"

namespace qdot {

class EquationSize {
 public:
  /// Keeps a reference to the motion.
  EquationSize(const ExpectedSystem& system, RightMotion& right, const Expression& residual);

  /// 0 where it cannot be told.
  double operator()(State state);

 private:
  /// Slopes, then the terms of each f_i.
  std::vector<Expression> roots(const ExpectedSystem& system, const Expression& residual);
  [[nodiscard]] double size_of_row(std::size_t i, const std::vector<Ball>& row) const;

  RightMotion& right_;
  std::size_t unknowns_;
  std::vector<std::size_t> ends_;
  std::vector<Expression> roots_;
  BallValues values_;
};

}  // namespace qdot
