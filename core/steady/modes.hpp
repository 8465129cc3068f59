#pragma once
// Small motions u about an equilibrium or steady motion:
//
//   M u'' + (G + C) u' + K u = 0,   u(t) = Re(shape e^(s t)),   s = rate + i omega
//
// M mass, K stiffness, G (skew) gyroscopic and C (symmetric) damping matrix, all derivatives of the scene's
// equations. Without G and C, s^2 = -lambda with K v = lambda M v (Goldstein, Classical Mechanics, 3rd ed.,
// 6.2); otherwise s solves the quadratic problem in its state form (Meirovitch, Fundamentals of Vibrations,
// 2001, 7.12). Ignorable coordinates are taken out first (core/mechanics/reduction.hpp): each is one rigid
// mode, and takes part in the others with its momentum unchanged. Matrices are evaluated in ball arithmetic
// at an enclosed equilibrium, and the eigenvalues are enclosed (core/numerics/eigensystem.hpp), so that every
// error is a bound.

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/numerics/real.hpp"
#include "core/steady/equilibrium.hpp"
#include "core/steady/mode.hpp"

namespace qdot {

enum class Stability { stable, unstable, neutral };
[[nodiscard]] const char* name(Stability stability);

/// Matrices are N x N by rows in the scene's coordinates and units.
struct Modes {
  std::vector<double> y;                       ///< (q, q') of the equilibrium or steady motion
  std::vector<std::optional<double>> y_error;  ///< none where the place is not isolated
  /// Where symmetries make a family of equilibria: coordinates that tell its members apart. They are kept,
  /// and the errors are those of the others beside them.
  std::vector<std::size_t> held;
  std::optional<Arrival> arrival;  ///< without a guess
  std::vector<Real> momenta;       ///< of the ignorable coordinates, which the small motions keep
  Stability stability{};
  std::string undecided;  ///< why it is neutral, or what is left undamped, a sentence
  std::vector<double> mass, stiffness;
  std::vector<double> gyroscopic, damping;  ///< empty where zero
  std::vector<Mode> modes;                  ///< by omega; at 0 in the order of ModeKind
};

/// `initial` (q, q') gives ignorable coordinates their momenta and all coordinates a guess; `guess` (q),
/// where given, is the equilibrium meant or near it. Without, the one that lies downhill of
/// `initial` (equilibrium_downhill).
/// Throws Error(not_applicable) where the time enters the equations or no equilibrium is near.
[[nodiscard]] Modes normal_modes(const Dynamics& dynamics, const Reals& parameters, const Reals& initial,
                                 const std::optional<std::vector<double>>& guess = std::nullopt);

}  // namespace qdot
