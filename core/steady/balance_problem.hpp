#pragma once
// The forces at one position as functions of one unknown number u (core/steady/solve_for.hpp), with what is
// needed to find their zeros and to tell whether the system stays there.

#include <memory>
#include <string>
#include <vector>

#include "core/numerics/interval.hpp"
#include "core/steady/kinks.hpp"
#include "core/steady/position_statics.hpp"
#include "core/steady/steady_polynomial.hpp"

namespace qdot {

/// Kinks of the forces in x and u.
struct BalanceKinks {
  bool move{};  ///< with u
  SmoothForces at_rest;
};

struct BalanceProblem {
  const Dynamics& dynamics;
  std::string unknown;
  Reals parameters, y;  ///< y = (q, q'): the position, and the velocities of the ignorable coordinates
  PositionStatics position;
  std::shared_ptr<const SteadyPolynomial> polynomial;
  std::shared_ptr<const BalanceKinks> kinks;
  std::vector<Interval> x, near;    ///< the position as typed, and with the doubles next to it
  std::vector<Interval> constants;  ///< parameters, then velocities of the ignorable coordinates
  Domain domain;                    ///< of u

  [[nodiscard]] const Scene& scene() const { return dynamics.model().scene; }
  [[nodiscard]] const Reduction& reduction() const { return position.statics->reduction; }
  /// Multipliers are numbered after the scene's coordinates.
  [[nodiscard]] bool is_multiplier(std::size_t i) const { return i >= y.size() / 2; }
  [[nodiscard]] bool solves_for_parameter() const { return polynomial->place < parameters.size(); }
  /// Of the ignorable coordinate whose velocity u is, in y.
  [[nodiscard]] std::size_t velocity_place() const {
    return y.size() / 2 + reduction().ignored[polynomial->place - parameters.size()];
  }
};

[[nodiscard]] BalanceProblem balance_problem(const Dynamics& dynamics, const Reals& parameters,
                                             const Reals& y, const std::string& unknown);

/// The forces at `position` as a polynomial of `unknown`.
[[nodiscard]] std::shared_ptr<const SteadyPolynomial> polynomial_of(const Dynamics& dynamics,
                                                                    const PositionStatics& position,
                                                                    const Reals& parameters,
                                                                    const std::string& unknown);

}  // namespace qdot
