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
  std::vector<std::string> units;      ///< of x
  std::vector<Expression> forces;      ///< g
  std::vector<Expression> surface;     ///< what constraints keep at 0
  std::vector<std::size_t> moving;     ///< the coordinates u, by number
  std::vector<std::size_t> following;  ///< those whose rates follow from u: ignored, or dependent
  std::vector<Expression> momenta;     ///< of the ignored coordinates, those that are not 0
  Matrix mass, stiffness, damping;     ///< D, with gyroscopic terms
  Matrix following_rates;              ///< dq_c'/du_j' at rest
  Matrix following_slopes;             ///< dq_c'/du_j
  /// Of allowed motions, what has roots, and as it was written at the place: by the signs that were there.
  std::vector<Replacement> taken{};
};

/// `vanishes`: whether its momentum is 0, for each ignored coordinate; those of all are where it is empty.
[[nodiscard]] LinearMotions linear_motions(const Reduction& reduction, const Scene& scene,
                                           const std::vector<bool>& vanishes = {});

/// Whether the momenta of the ignored coordinates vanish in the state y = (q, q').
[[nodiscard]] bool momenta_vanish(const Dynamics& dynamics, const Statics& statics, const Reals& parameters,
                                  std::span<const double> y);

/// What is looked for near a place in x, whose values x then has.
[[nodiscard]] PlaceProblem place_problem(const LinearMotions& motions, ExactValues& values,
                                         std::span<const Interval> near);

/// Of all coordinates, those with these numbers.
[[nodiscard]] std::vector<Interval> those_of(std::span<const Interval> all,
                                             std::span<const std::size_t> coordinates);

}  // namespace qdot
