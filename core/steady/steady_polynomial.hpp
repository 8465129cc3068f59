#pragma once
// The forces at rest as functions of one unknown number u, which is a parameter or the velocity of an
// ignorable coordinate. All ignorable coordinates move with given velocities here, not with given momenta.

#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/dynamics/dynamics.hpp"

namespace qdot {

/// Functions of the parameters and the velocities of the ignored coordinates (in that order) and of x.
struct SteadyPolynomial {
  struct Force {
    std::size_t equation{};     ///< place in g
    bool depends{};             ///< on u
    std::optional<int> degree;  ///< in u: 0, 1 or 2; none where it is no such polynomial
    bool linear_vanishes{};     ///< the coefficient of u vanishes identically
  };
  std::size_t place{};              ///< of u among the constants
  std::vector<Force> forces;        ///< those that do not vanish identically
  CompiledFunction coefficients;    ///< of 1, u, u^2 for each force
  CompiledFunction divisors;        ///< of x: what forces divide by, where u does not matter to it
  CompiledFunction poles;           ///< of x and u: what forces divide by, where u matters to it
  CompiledFunction slopes;          ///< of these along x; only for one coordinate
  CompiledFunction values;          ///< each force at x and u (variables x, u)
  CompiledFunction derivatives;     ///< along u
  CompiledFunction momenta;         ///< of the ignored coordinates
  std::vector<bool> turns;          ///< for each x: see SteadyForces
  std::vector<std::size_t> needed;  ///< places in x that some force depends on
  std::vector<Expression> forms;    ///< `coefficients` as expressions, in `graph`
  std::vector<Expression> whole;    ///< `values` as expressions, numerators along u
  std::vector<Expression> pole_forms;
  Expression stiffness, inertia;  ///< K and M of one coordinate, also there; else without a value
  std::shared_ptr<const Graph> graph;
  bool u_turns{};  ///< a full turn of u changes no force
};

/// `forces` are the statics' g, or combinations of them that vanish where the system rests, in `graph`: the
/// statics' own, or a copy of it.
[[nodiscard]] SteadyPolynomial derive_steady_polynomial(const Model& model, const Statics& statics,
                                                        const Graph& graph,
                                                        const std::vector<Expression>& forces,
                                                        const std::string& unknown);

}  // namespace qdot
