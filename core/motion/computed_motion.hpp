#pragma once
// A motion and what it was computed for and by: what is compared with other computations of it.

#include <cstddef>

#include "core/dynamics/dynamics.hpp"
#include "core/motion/dense_grid.hpp"
#include "core/motion/event_rows.hpp"

namespace qdot {

/// A motion that was computed on a grid, and how.
struct ComputedMotion {
  const Dynamics& dynamics;
  const SimulationRequest& request;  ///< what was asked for
  const DenseGrid& grid;
  const EventRows& event_rows;   ///< on that grid
  const Simulation& simulation;  ///< on all of the grid
  Tolerances tolerances;         ///< of the simulation
  bool is_stiff;                 ///< explicit methods are of no use

  [[nodiscard]] std::size_t width() const { return request.y_start.size(); }
  [[nodiscard]] bool is_near_round_off() const;
  [[nodiscard]] bool has_events_in_doubt() const;
};

/// Tolerances from which on round-off counts beside them, and at which steps are long.
inline constexpr double near_round_off = 1e-12, loose_tolerance = 1e-6;
inline constexpr double tightest_tolerance = 1e-15;  ///< rtol of a run that is returned

}  // namespace qdot
