#pragma once
// Stability of an equilibrium or steady motion, from
//
//   M x'' + D x' + K x = 0,   M_ij = dE_i/dx_j'',  D_ij = dE_i/dx_j',  K_ij = dE_i/dx_j,
//
// x the coordinates that are left when the ignorable ones are reduced, their momenta kept, as
// linear_stability.hpp decides it. With one degree of freedom the first derivative of U that does not vanish
// decides where it does not: of odd order or negative: unstable; of even order and positive: stable.

#include <span>
#include <string>

#include "core/compile/tape_evaluator.hpp"
#include "core/steady/inertia.hpp"
#include "core/steady/linear_stability.hpp"
#include "core/steady/steady_forces.hpp"

namespace qdot {

/// For one set of constants and many places x.
class StabilityAnalysis {
 public:
  StabilityAnalysis(const Dynamics& dynamics, const SteadyProblem& problem);

  /// `x` encloses the place.
  [[nodiscard]] SteadyStability at(std::span<const Interval> x);

  /// False where a mass matrix without negative directions may have no inverse at some place in x.
  [[nodiscard]] bool has_inertia(std::span<const Interval> x);

  /// The energy decides what is stable near x: M is positive definite, and nothing but a potential,
  /// gyroscopic terms and damping acts. Gyroscopic terms: D is not zero.
  struct Energy {
    bool decides{}, gyroscopic{};
  };
  [[nodiscard]] Energy energy(std::span<const Interval> x);

 private:
  [[nodiscard]] std::vector<Interval> matrix(TapeEvaluator<Interval>& function,
                                             std::span<const Interval> x) const;
  [[nodiscard]] LinearizedForces linearized(std::span<const Interval> x);
  [[nodiscard]] std::string next_terms(std::span<const Interval> x);

  const Dynamics& dynamics_;
  SteadyProblem problem_;
  std::size_t n_;
  TapeEvaluator<Interval> inertia_, damping_, stiffness_;
};

}  // namespace qdot
