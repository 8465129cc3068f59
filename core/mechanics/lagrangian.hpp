#pragma once
// From where things are to L(q, q', t).
//
//   T = sum of m/2 v.v + sum of I/2 w^2,  v = dr/dt by the chain rule  (parsed_body.hpp)
//   V = - sum of m g.r + sum of k/2 (length - rest_length)^2 + extra potential
//   Q_i = sum of F . dr/dq_i + sum of torque . domega/dq_i'  (virtual work of forces and torques)
//         - dD/dq_i' + sum of lambda_j A_ji                  (Rayleigh dissipation D; constraints.hpp)
//   L = T - V
// Sources: Goldstein, Classical Mechanics, 3rd ed., 1.4 (Q_i), 1.5 (D); the rod's T integrates a velocity
// that is linear along it.

#include <optional>

#include "core/mechanics/constraints.hpp"
#include "core/mechanics/parsed_scene.hpp"

namespace qdot {

struct Lagrangian {
  std::shared_ptr<Graph> graph;
  Symbols symbols;
  Expression lagrangian;  ///< L [J]
  /// T and V [J]; absent when the scene gives only L.
  std::optional<Expression> kinetic_energy, potential_energy;
  /// Q_i, what is not in L [J per unit of q_i].
  std::vector<Expression> generalized_forces;
  /// L before the held lengths are held: a function of them and their rates too.
  Expression varied;
  /// The generalized force along each held length, of what is not in L.
  std::vector<Expression> held_forces;
  std::vector<ConstraintEquation> constraints;
  std::vector<Replacement> holding;  ///< held length, its value; its rates, zero
};

[[nodiscard]] Lagrangian derive_lagrangian(const ParsedScene& scene);

/// The same on a copy of its graph, where more may be derived without touching the original.
[[nodiscard]] Lagrangian copied(const Lagrangian& lagrangian);

/// L, T, V and the forces with symbols replaced; parameters by 0, say, or inputs by functions of time.
[[nodiscard]] Lagrangian replaced(const Lagrangian& lagrangian, std::span<const Replacement> replacements);

/// "kg*m^2/s" for the momentum of coordinate i: action over the coordinate's unit.
[[nodiscard]] std::string momentum_unit(const Scene& scene, std::size_t coordinate);

/// The part of e of degree n in the velocities: T = T2 + T1 + T0.
[[nodiscard]] Expression velocity_degree(const Expression& e, const Symbols& symbols, int n);

/// e in short form; where it mixes degrees in the velocities, each part by itself: T2 + T1 + T0.
[[nodiscard]] Expression simplify_by_degree(const Expression& e, const Symbols& symbols);
/// The same, with terms without velocities kept as they are written (kept_terms.hpp).
[[nodiscard]] Expression shortened_by_degree(const Expression& e, const Symbols& symbols);

/// p_i = dL/dq_i'.
[[nodiscard]] std::vector<Expression> conjugate_momenta(const Lagrangian& lagrangian);

/// h = sum p_i q_i' - L, the Jacobi integral [J].
[[nodiscard]] Expression jacobi_integral(const Lagrangian& lagrangian);

/// sign (d/dt dL/ds' - dL/ds - Q_s) with the held length s varied and then held [N for a length]; contains
/// q_ddot.
[[nodiscard]] Expression reaction(const Lagrangian& lagrangian, const ParsedReaction& which);

}  // namespace qdot
