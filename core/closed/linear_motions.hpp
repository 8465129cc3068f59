#pragma once
// The equations M u'' + G u' + K u = 0 of small motions at an equilibrium, by the parameters, and their
// solutions. Of two coordinates that gyroscopic terms couple, lambda = omega^2 solves
//
//   (k11 - lambda m11)(k22 - lambda m22) - (k12 - lambda m12)^2 - lambda g^2 = 0,   g = g12 = -g21
//
// (Goldstein, Classical Mechanics, 5.7: the top).

#include <memory>
#include <optional>
#include <vector>

#include "core/closed/exact_place.hpp"
#include "core/closed/exact_values.hpp"
#include "core/dynamics/dynamics.hpp"
#include "core/expr/linear.hpp"
#include "core/expr/surd.hpp"

namespace qdot {

/// At any place x, in a graph of its own.
struct LinearMotions {
  std::shared_ptr<Graph> graph;
  std::vector<Expression> x;
  std::vector<Expression> forces;   ///< g
  Matrix mass, stiffness, damping;  ///< D, with gyroscopic terms
  Matrix ignored_rates;             ///< dq_c'/dx_j' of the ignored coordinates at rest
  Matrix ignored_slopes;            ///< dq_c'/dx_j
};

/// `momenta_vanish`: of the ignored coordinates.
[[nodiscard]] LinearMotions linear_motions(const Statics& statics, bool momenta_vanish);

/// Whether the momenta of the ignored coordinates vanish in the state y = (q, q').
[[nodiscard]] bool momenta_vanish(const Dynamics& dynamics, const Statics& statics, const Reals& parameters,
                                  std::span<const double> y);

/// What is looked for near a place in q.
[[nodiscard]] PlaceProblem place_problem(const LinearMotions& motions, const Statics& statics,
                                         const ExactValues& values, std::span<const Interval> near);

/// lambda and the shape, in the coordinates x; no shape of two coordinates that gyroscopic terms couple.
struct LinearMode {
  Surd lambda;
  std::vector<Surd> shape;
  std::vector<std::size_t> group;  ///< the coordinates that it moves
};

/// All modes at a place, `relations` put in; those of groups of more than two coordinates, and of damped
/// ones, are missing.
[[nodiscard]] std::vector<LinearMode> modes_at(const LinearMotions& motions, const ExactPlace& place,
                                               std::span<const Replacement> relations);

}  // namespace qdot
