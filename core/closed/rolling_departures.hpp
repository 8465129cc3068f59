#pragma once
// The first-order equations xi' = R xi of small departures from a steady motion under constraints in the
// velocities (core/steady/rolling_modes.hpp), by the parameters.

#include "core/closed/exact_values.hpp"
#include "core/closed/rational_rows.hpp"
#include "core/mechanics/lagrangian.hpp"
#include "core/steady/modes.hpp"

namespace qdot {

/// Rates that a request or a scene gives by the parameters stand so, or as their symbols.
enum class GivenRates { as_written, as_symbols };

struct RollingDepartures {
  RationalRows matrix;            ///< R; empty where the equations do not say that the motion is steady
  std::vector<Expression> given;  ///< places and rates that stand as their symbols, which have values
};

/// `own`: in the graph of `values`, which takes the values of places and rates.
[[nodiscard]] RollingDepartures rolling_departures(const Lagrangian& own, ExactValues& values,
                                                   const Modes& found, GivenRates rates);

}  // namespace qdot
