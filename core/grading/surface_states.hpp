#pragma once
// States that obey the constraints, phi(q, t) = 0 and A q' + b = 0 (core/mechanics/constraints.hpp), as
// balls.
//
// Newton's method takes a sampled place to the surface, dq = -A^T (A A^T)^-1 phi. Then as many coordinates as
// there are phi depend on the others, which stay the doubles that they are, and Krawczyk's test encloses them
// (proven_root.hpp); dependent velocities come of a linear system. What vanishes on the surface alone then
// vanishes at such a state to some 1e-30.

#include <vector>

#include "core/grading/ball_values.hpp"
#include "core/grading/expected_system.hpp"
#include "core/grading/vanishing.hpp"

namespace qdot {

class SurfaceStates {
 public:
  explicit SurfaceStates(const ExpectedSystem& system);

  /// Moves a state, values of the system's domains, to the surface, rounded to doubles. False where there is
  /// no such place near, or it lies outside the domains.
  [[nodiscard]] bool move(State& state);
  /// Of the last state: (symbol, enclosure) of every coordinate and velocity.
  [[nodiscard]] const std::vector<std::pair<Expression, Ball>>& place() const { return place_; }

 private:
  [[nodiscard]] bool find_place();
  [[nodiscard]] bool approach();
  [[nodiscard]] bool enclose();
  [[nodiscard]] bool solve_rates();
  [[nodiscard]] bool is_inside() const;
  void evaluate();
  [[nodiscard]] std::vector<Ball> seen(const std::vector<Expression>& expressions) const;
  /// A of the first `count` constraints in the chosen columns.
  [[nodiscard]] std::vector<std::vector<Ball>> slopes(std::size_t count,
                                                      const std::vector<std::size_t>& columns) const;

  std::vector<SymbolDomain> symbols_;
  std::vector<Expression> phi_;                 ///< of the holonomic constraints, which stand first
  std::vector<std::vector<Expression>> slope_;  ///< A
  std::vector<Expression> drift_;               ///< b
  std::size_t n_{}, first_coordinate_{};
  BallValues values_;
  std::vector<Ball> q_, rate_;
  std::vector<std::pair<Expression, Ball>> place_;
};

}  // namespace qdot
