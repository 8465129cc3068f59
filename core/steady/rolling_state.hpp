#pragma once
// The first-order equations xi' = R xi of small departures from a steady motion under constraints in the
// velocities, with xi = (p, v) of rolling_modes.hpp, and the eigenvalues of R.
//
// A column of R that is zero belongs to a departure that drives nothing: another place to be in, another rate
// to spin at. Its s is 0, and it is taken out, until no such column is left.

#include <vector>

#include "core/steady/steady_rolling.hpp"

namespace qdot {

class RollingState {
 public:
  /// Throws Error(not_applicable) where constraints depend on each other, and with too many coordinates.
  explicit RollingState(const SteadyRolling& motion);

  /// No force and no constraint depends on rates, to first order: with s, -s is an eigenvalue.
  [[nodiscard]] bool is_reversible() const { return reversible_; }
  /// A basis of the displacements that constraints allow and that drive nothing.
  [[nodiscard]] std::vector<std::vector<ComplexBall>> free_displacements() const;
  /// Of R without what was taken out.
  [[nodiscard]] Eigensystem<ComplexBall> eigenvalues() const;
  /// u of eigenvalue i; what was taken out goes along, except where s may be 0.
  [[nodiscard]] std::vector<ComplexBall> shape(const Eigensystem<ComplexBall>& found, std::size_t i) const;

 private:
  [[nodiscard]] std::vector<Ball> held_back(const std::vector<Ball>& u) const;
  [[nodiscard]] std::vector<ComplexBall> displacement(const std::vector<ComplexBall>& xi) const;
  void write_departures(const SolvedSlopes& of_places);
  void write_matrix(const SolvedSlopes& of_places);
  void take_out_what_drives_nothing();

  const SteadyRolling& motion_;
  std::size_t n_, d_{};
  SolvedSlopes of_rates_;             ///< Z and A_D^-1
  BallMatrix place_, rate_;           ///< u and u' of each xi, n x d
  BallMatrix matrix_;                 ///< R
  std::vector<std::size_t> active_;   ///< of xi
  std::vector<std::size_t> removed_;  ///< of xi, in the order in which they were taken out
  bool reversible_{};
};

}  // namespace qdot
