#pragma once
// Stability of x = 0 for small motions
//
//   M x'' + D x' + K x = 0
//
//   - forces with a potential U: K = d2U/dx2 positive definite: stable (Lagrange, Dirichlet; Routh for steady
//     motions); an odd number of negative directions: unstable, whatever gyroscopic terms there are (Thomson
//     and Tait); any negative direction without gyroscopic terms: unstable
//     Coordinates that no force depends on, though inertia may, are left out of K: they drift, and the energy
//     still bounds the others. So is, for each direction of a family of equilibria, one in which it moves
//   - the same with damping, which takes energy only (D + D^T positive definite): stable
//   - else the eigenvalues s of (M s^2 + D s + K) v = 0, enclosed (core/steady/spectrum.hpp): all with a
//     negative real part: stable; one with a positive one: unstable
//   - else linearization does not decide: neutral.
// The signs that stable and unstable rest on are proven: matrices are enclosed over an enclosure of the
// place. Source: Merkin, Introduction to the Theory of Stability (1997), chapters 3, 5 and 6.

#include <complex>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "core/numerics/interval.hpp"
#include "core/steady/modes.hpp"

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

struct LinearizedForces {
  std::size_t n{};
  std::vector<Interval> mass, rates, stiffness;  ///< M, D and K by rows
  bool symmetric{};                              ///< K, wherever one is: g = dU/dx
  bool has_potential{};                          ///< the same, and no force depends on a velocity
  std::vector<std::size_t> free{};               ///< places of coordinates that are left out of K
};

/// K is that of a potential, D skew and M positive definite; an equation divided by its vanishing mass
/// belongs to no potential.
[[nodiscard]] bool has_potential(const LinearizedForces& at);

/// M and K positive definite, g = dU/dx, and D + D^T positive definite but for rows that are 0: where the
/// equations are linear, energy stays or is lost, and bounds what does not decay.
[[nodiscard]] bool never_gains_energy(const LinearizedForces& at);

/// What the terms of a potential of one coordinate beyond K do, a sentence.
using NextTerms = std::function<std::string()>;

[[nodiscard]] SteadyStability linear_stability(const LinearizedForces& at, const NextTerms& next_terms);

}  // namespace qdot
