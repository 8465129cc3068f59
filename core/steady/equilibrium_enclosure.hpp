#pragma once
// The proof that a place x where the forces g vanish in doubles is an equilibrium: Newton's iteration in
// twice the digits, then Krawczyk's operator on a box x +- r,
//
//   |C g(x)| + |I - C K(x +- r)| r <= r,   K = dg/dx,  C near K^-1,
//
// which proves one zero in the box. Source: Neumaier, Interval Methods for Systems of Equations (1990), 5.1.

#include <Eigen/Core>
#include <optional>
#include <span>
#include <vector>

#include "core/dynamics/statics.hpp"
#include "core/numerics/ball.hpp"

namespace qdot {

struct Equilibrium {
  std::vector<Ball> x;  ///< encloses it, where it is isolated
  /// Proven to be the only one nearby, apart from moving along the coordinates that no force depends on, and
  /// along `family`.
  /// Otherwise x is a place without forces, as far as rounding lets one see, and as wide as Newton's steps
  /// leave open.
  bool isolated{};
  /// Of one of the family that symmetries make of it (equilibrium_family.hpp): independent directions to the
  /// others, along which nothing drives back.
  std::vector<std::vector<Ball>> family{};
  std::vector<std::size_t> held{};  ///< as many places in x, which tell the members of the family apart
};

/// Where Newton's iteration in doubles has arrived.
struct NearlyEquilibrium {
  Eigen::VectorXd x;
  Eigen::MatrixXd inverse;  ///< C
  std::vector<bool> free;   ///< coordinates that no force depends on: they stay
  /// Of each coordinate: a coordinate below 1e-6 of it may be zero exactly.
  std::vector<double> sizes;
};

/// `constants` are the reduction's. No value where the forces do not vanish nearby.
[[nodiscard]] std::optional<Equilibrium> enclosed_equilibrium(const Statics& statics,
                                                              std::span<const Ball> constants,
                                                              const NearlyEquilibrium& near);

}  // namespace qdot
