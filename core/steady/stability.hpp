#pragma once
// Stability of an equilibrium or steady motion, from
//
//   M x'' + D x' + K x = 0,   M_ij = dE_i/dx_j'',  D_ij = dE_i/dx_j',  K_ij = dE_i/dx_j,
//
// x the coordinates that are left when the ignorable ones are reduced, their momenta kept.
//   - forces with a potential U: K = d2U/dx2 positive definite: stable (Lagrange, Dirichlet; Routh for steady
//     motions); an odd number of negative directions: unstable, whatever gyroscopic terms there are (Thomson
//     and Tait); any negative direction without gyroscopic terms: unstable
//   - the same with damping, which takes energy only (D + D^T positive definite): stable
//   - else the eigenvalues s of (M s^2 + D s + K) v = 0, enclosed (core/steady/spectrum.hpp): all with a
//     negative real part: stable; one with a positive one: unstable
//   - else linearization does not decide: neutral. With one degree of freedom the first derivative of U that
//     does not vanish does: of odd order or negative: unstable; of even order and positive: stable.
// The signs that stable and unstable rest on are proven: matrices are enclosed over an enclosure of x.
// Source: Merkin, Introduction to the Theory of Stability (1997), chapters 3, 5 and 6.

#include <complex>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/compile/tape_evaluator.hpp"
#include "core/steady/inertia.hpp"
#include "core/steady/modes.hpp"
#include "core/steady/steady_forces.hpp"

namespace qdot {

struct SteadyStability {
  Stability stability{Stability::neutral};
  std::string undecided;  ///< where neutral: why, and what the next terms of the potential do; a sentence
  struct Eigenvalue {
    std::complex<double> s;  ///< [1/s]
    double error{};          ///< bound of |s - exact|; not finite where nothing could be proven
  };
  std::vector<Eigenvalue> eigenvalues;  ///< 2n of them, by real, then imaginary part
  /// omega^2 = K/M [1/s^2], negative where it grows; with one degree of freedom and no damping.
  std::optional<Interval> rate2;
};

/// For one set of constants and many places x.
class StabilityAnalysis {
 public:
  StabilityAnalysis(const Dynamics& dynamics, const SteadyProblem& problem);

  /// `x` encloses the place.
  [[nodiscard]] SteadyStability at(std::span<const Interval> x);

  /// The energy decides what is stable near x: M is positive definite, and nothing but a potential,
  /// gyroscopic terms and damping acts. Gyroscopic terms: D is not zero.
  struct Energy {
    bool decides{}, gyroscopic{};
  };
  [[nodiscard]] Energy energy(std::span<const Interval> x);

 private:
  using Matrix = std::vector<Interval>;

  [[nodiscard]] Matrix values(TapeEvaluator<Interval>& function, std::span<const Interval> x) const;
  [[nodiscard]] bool has_potential(const Matrix& inertia, const Matrix& damping) const;
  [[nodiscard]] bool loses_energy(const Matrix& inertia, const Matrix& damping,
                                  const Matrix& stiffness) const;
  [[nodiscard]] std::string next_terms(std::span<const Interval> x) const;
  /// Of a neutral place, a sentence.
  [[nodiscard]] std::string why_undecided(const Matrix& inertia, const Matrix& stiffness, bool potential,
                                          std::span<const Interval> x) const;

  const Dynamics& dynamics_;
  SteadyProblem problem_;
  std::size_t n_;
  TapeEvaluator<Interval> inertia_, damping_, stiffness_;
};

}  // namespace qdot
