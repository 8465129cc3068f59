#pragma once
// The equations M u'' + G u' + K u = 0 of small motions at an equilibrium, by the parameters.

#include <memory>
#include <vector>

#include "core/closed/exact_place.hpp"
#include "core/closed/exact_values.hpp"
#include "core/dynamics/dynamics.hpp"
#include "core/expr/linear.hpp"

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

}  // namespace qdot
