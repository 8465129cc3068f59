#pragma once
// The forces g(x) of a scene at rest, made ready for a search of all their zeros: with what is known of g
// beforehand, and with their numerators, which tell near a pole of g that no zero is there.

#include <span>
#include <vector>

#include "core/dynamics/dynamics.hpp"
#include "core/numerics/interval.hpp"
#include "core/steady/cones.hpp"
#include "core/steady/kinks.hpp"

namespace qdot {

/// The velocities of the ignored coordinates at rest, in `graph`, a copy of the reduction's.
[[nodiscard]] std::vector<Expression> rates_at_rest(const Reduction& reduction, Graph& graph);

/// Some of the equations g = 0, as many as unknowns, that say the same as all of them in a part of the
/// region: where |D_k| is at least half of every |D_l|, and not 0.
struct Chart {
  std::vector<std::size_t> equations;    ///< places in g
  std::vector<std::size_t> determinant;  ///< places in x of the factors that D_k has the units of
};

/// What Statics has, derived once more without the momenta that are known to vanish: a steady motion without
/// momentum has no centrifugal wall. Functions of Statics' constants and x.
struct SteadyForces {
  std::vector<std::size_t> unknowns;   ///< places in x of the coordinates that some force depends on
  std::vector<std::size_t> free;       ///< the other places: any value does
  std::vector<std::size_t> equations;  ///< places in g of the forces that do not vanish identically
  std::vector<bool> turns;             ///< for each x: an angle whose full turn changes no force
  std::vector<Expression> rest;        ///< g, in `graph`
  std::shared_ptr<const Graph> graph;  ///< threads share it; derivations work on a copy
  CompiledFunction forces;             ///< g
  CompiledFunction stiffness;          ///< K_ij = dg_i/dx_j by rows
  CompiledFunction ignored_rates;      ///< q_c'
  SmoothForces smooth;                 ///< g on each side of its kinks
  bool has_poles{};                    ///< some g_i is not its numerator
  std::vector<ConeForms> cones;        ///< without constraints
  std::vector<Chart> charts;           ///< empty: `equations` are as many as unknowns, or there is no hope
  CompiledFunction determinants;       ///< D_k of the charts
  bool symmetric{};                    ///< K, so that g = dU/dx
  bool has_potential{};                ///< symmetric, and no force depends on a velocity
};

/// Equations of x in a graph of their own, and as they are written before they are made short.
struct RestEquations {
  std::shared_ptr<Graph> graph;
  std::vector<Expression> rest, written;
};

/// All but charts, cones, the ignored coordinates' rates and what is said of a potential.
[[nodiscard]] SteadyForces compiled_forces(const Model& model, const Reduction& reduction,
                                           const RestEquations& equations);

/// `absent`: symbols of momenta that are zero.
[[nodiscard]] SteadyForces derive_steady_forces(const Model& model, const Statics& statics,
                                                std::span<const Expression> absent);

/// A scene at rest with its numbers.
struct SteadyProblem {
  std::shared_ptr<const Statics> statics;
  std::shared_ptr<const SteadyForces> forces;
  Reals parameters;
  std::vector<Interval> constants;  ///< the parameters, then the momenta of the ignored coordinates
};

/// The forces of a scene without kinks are the gradient of a potential.
[[nodiscard]] bool is_gradient(const Model& model, const Statics& statics);
/// The same, and none depends on a velocity.
[[nodiscard]] bool has_potential(const Model& model, const Statics& statics);

/// The momenta of the ignored coordinates in the state y = (q, q'), enclosed: beside the parameters they are
/// what the forces know of y. Throws Error(invalid_state) where one has no finite value.
[[nodiscard]] std::vector<Interval> momenta_at(const Dynamics& dynamics, const Statics& statics,
                                               const Reals& parameters, const Reals& y);

/// The ignored coordinates' momenta that are zero, of which the forces are derived once more.
struct VanishingMomenta {
  std::vector<bool> vanishing;
  std::vector<Expression> absent;  ///< their symbols
  std::string key;                 ///< " 0" or " p" for each
};
[[nodiscard]] VanishingMomenta vanishing_momenta(const Statics& statics, std::span<const Interval> momenta);

/// Throws Error(not_applicable) where dry friction holds the system wherever it is left. `vanishing`: which
/// momenta of the ignored coordinates are zero.
void refuse_dry_friction(const Dynamics& dynamics, const Reals& parameters,
                         const std::vector<bool>& vanishing);

/// With the momenta of the ignored coordinates in the state y = (q, q'). Throws Error(not_applicable) where
/// the time enters the equations or dry friction holds the system wherever it is left, and
/// Error(invalid_state) where a momentum has no finite value.
[[nodiscard]] SteadyProblem steady_problem(const Dynamics& dynamics, const Reals& parameters, const Reals& y);

}  // namespace qdot
