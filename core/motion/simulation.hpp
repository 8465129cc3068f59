#pragma once
// A motion: from parameters and an initial state to columns on a grid, events, and how it ended.

#include <optional>
#include <string>
#include <vector>

#include "core/dynamics/watch.hpp"
#include "core/integrate/run.hpp"
#include "core/numerics/real.hpp"

namespace qdot {

struct SimulationRequest {
  Reals parameters;  ///< all of them, in order
  Reals y_start;     ///< q, then q'
  double t_start{};
  double t_end{};
  std::vector<double> grid;         ///< increasing, in [t_start, t_end]
  std::vector<Column> columns;      ///< wanted beside the state
  std::vector<std::string> events;  ///< "theta = 0+", or names of the scene's events
  OnInvalid on_invalid{OnInvalid::stop};
  Impacts impacts{Impacts::apply};
  std::optional<std::size_t> end_after_impacts{};  ///< the motion is complete after so many, at least one
  Method method{Method::adams};
  unsigned taylor_order{};  ///< 0: by the tolerance
  Tolerances tolerances;    ///< not of gauss
  double h{};               ///< step of gauss
  Limits limits;
};

struct EventRecord {
  std::string name;
  double t{};
  std::vector<double> y;  ///< before the impact, where the event is one
};

/// A section of the motion that an impact ended.
struct SectionRecord {
  double t{};                         ///< of that impact
  double duration{};                  ///< since the impact before, or since t_start
  std::vector<double> before, after;  ///< the state just before the impact and just after it
};

/// A time in which the motion stayed on a kink of its equations: a block that sticks.
struct StayRecord {
  std::string kink;  ///< the expression that stays 0
  double from{}, to{};
};

/// Why a motion ended before t_end in the nature of the system.
struct Stop {
  std::string reason;  ///< "string_slack", "lift_off", "fall", "coordinate_singularity"
  double t{};
  std::string message;
};

struct ConservedRecord {
  std::string name;
  std::string unit;
  double initial{};
  double max_abs_drift{};               ///< over the returned rows
  std::optional<double> max_rel_drift;  ///< over |initial|; no value where that is 0
};

struct Simulation {
  std::size_t rows{};           ///< instants of the grid that were reached
  std::vector<double> states;   ///< rows x 2n, row-major
  std::vector<double> columns;  ///< rows x request.columns, row-major
  std::vector<EventRecord> events;
  std::vector<SectionRecord> sections;  ///< in order, one that an impact at t_end itself ended included
  std::vector<StayRecord> stays;        ///< in order of their ends
  std::optional<Stop> stop;
  /// `event` when stopped; anything but that and reached_end is a failure.
  Ending ending{Ending::reached_end};
  double t{};             ///< how far it came
  std::vector<double> y;  ///< the state there, before an impact that ends the motion
  std::vector<ConservedRecord> conserved;
  Method method{};
  /// gauss: whether it stepped in (q, p). It steps in (q, q') where p = dL/dq' does not determine q': for an
  /// L that is not quadratic in q', and where a coordinate has no inertia
  /// in the initial state (massless parts).
  bool symplectic{false};
  std::uint64_t steps{};
  std::uint64_t evaluations{};
  bool bounded{true};          ///< as Run::bounded, of all sections
  std::vector<double> unseen;  ///< as Run::unseen, rows x 2n; empty where there is nothing
};

/// Where abs and sign stand in the equations, every zero of their arguments ends a section of the motion that
/// is smooth, and the next one begins on the other side or stays there (kink_modes.hpp); not for gauss, whose
/// step is fixed. Throws Error(invalid_state) when the initial state describes no configuration,
/// and what Dynamics::event throws.
[[nodiscard]] Simulation simulate(const Dynamics& dynamics, const SimulationRequest& request);

}  // namespace qdot
