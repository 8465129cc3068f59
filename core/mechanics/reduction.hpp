#pragma once
// A motion without its ignorable coordinates: Routh's reduction (Goldstein, Classical Mechanics, 3rd
// ed., 8.3), and the equations of what is left.
//
//   R(x, x'; p) = L - sum p_c q_c'   over the ignorable coordinates q_c, their velocities eliminated
//   E_i = d/dt dR/dx_i' - dR/dx_i - Q_i = 0   for the coordinates x that are left
// A steady motion (x' = 0, every q_c' constant) is a zero of E(x, 0, 0),
// an equilibrium if nothing is ignorable.

#include <memory>
#include <vector>

#include "core/mechanics/lagrangian.hpp"

namespace qdot {

struct Reduction {
  std::shared_ptr<Graph> graph;
  std::vector<std::size_t> kept, ignored;    ///< coordinates by number
  std::vector<Expression> x, x_dot, x_ddot;  ///< symbols of the kept ones
  /// The scene's parameters, then p_c of each ignored coordinate.
  std::vector<Expression> constants;
  Expression routhian;                ///< R [J]; L where nothing is ignorable
  std::vector<Expression> equations;  ///< E_i(x, x', x''), undivided unless it vanishes
  std::vector<std::size_t> limits;  ///< coordinates whose equation vanishes, so that its limit stands for it
  /// E_i(x, 0, 0) as -dR/dx_i - Q_i gives it, where it loses digits multiplied out (kept_terms.hpp).
  std::vector<Expression> forces_at_rest;
  std::vector<Expression> ignored_rates;  ///< q_c'(x, x'; p)
  bool autonomous{};                      ///< no E_i contains the time
  /// The E_i are those of R without an exponential of the time that they share, as exp(b t) of a damped
  /// oscillator's Lagrangian: they are no gradients, and R contains the time.
  bool without_growth{};
  /// Every Q_i is zero and R does not contain the time, so that h = sum x_i' dR/dx_i' - R stays constant.
  bool conservative{};

  [[nodiscard]] std::size_t degrees_of_freedom() const { return kept.size(); }
};

enum class Ignorable { taken_out, kept };

/// Works on a graph of its own. What is ignorable depends on the parameters: ask for the Lagrangian with the
/// vanishing ones replaced by 0. An equation may vanish with them, such as that of a pendulum whose bob loses
/// its mass. Its limit then takes its place: left - right of Lagrange's equation of that coordinate, divided
/// by its common factor before that vanished.
/// `divided` has these for all coordinates in order, in the Lagrangian's graph.
[[nodiscard]] Reduction derive_reduction(const Lagrangian& lagrangian,
                                         const std::vector<Expression>& divided = {},
                                         Ignorable ignorable = Ignorable::taken_out);

/// e with x' = x'' = 0.
[[nodiscard]] Expression at_rest(const Reduction& reduction, const Expression& e);

}  // namespace qdot
