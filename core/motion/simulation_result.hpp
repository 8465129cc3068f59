#pragma once
// What a motion gives: rows on a grid, events, and how it ended.

#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/motion/drift.hpp"
#include "core/motion/section_record.hpp"
#include "core/motion/simulation_request.hpp"
#include "core/numerics/interval.hpp"

namespace qdot {

struct EventRecord {
  std::string name;
  double t{};
  std::vector<double> y;  ///< before the impact, where the event is one
  bool is_in_doubt{};     ///< in another order of the impacts of its instant it may not happen
  double untold{};        ///< for this many seconds around it the signs were not known
};

/// An event whose function's sign was not seen from some instant to the end of a section.
struct UntoldRecord {
  std::string name;
  double from{};
};

/// Why a motion ended before t_end in the nature of the system.
struct Stop {
  std::string reason;  ///< "string_slack", "lift_off", "fall", "coordinate_singularity"
  double t{};
  std::string message;
  double doubt{};  ///< of t, where impacts accumulate: an estimate beside their own errors
};

/// As the tables of these names below, with a row for each instant of EventRows::events() that was reached.
struct RowsOfEvents {
  std::vector<double> states, unseen, apart;
};

/// Where the motion nearly meets what would change its way, or has nearly missed it (run.hpp).
struct ApproachRecord {
  Approach place;
  std::string name;  ///< of a kink, the expression that is zero there; of an impact or a condition
  bool is_kink{};
  bool ends_motion{};  ///< a condition, or a singularity
  bool stays{};        ///< on the kink, up to there
  double begun{};      ///< when the run began, after an impact or a kink
  /// What is zero there, over a box of states.
  std::function<Interval(double t, std::span<const Interval> y)> enclosure;
  /// Of a condition, and of what stands in a jump: the same of the event that it decides about.
  std::function<Interval(double t, std::span<const Interval> y)> of_event{};
};

struct Simulation {
  std::size_t rows{};           ///< instants of the grid that were reached
  std::vector<double> states;   ///< rows x 2n, row-major
  std::vector<double> columns;  ///< rows x request.columns, row-major
  std::vector<EventRecord> events;
  std::vector<SectionRecord> sections;      ///< in order, one that an impact at t_end itself ended included
  std::vector<PieceRecord> pieces;          ///< of a motion with kinks, in order
  std::vector<StayRecord> stays;            ///< in order of their ends
  std::vector<ApproachRecord> approaches;   ///< where the request wants them
  std::vector<ApproachRecord> near_events;  ///< the same of events that are reported only
  std::vector<UntoldRecord> untold;         ///< of events that are reported only
  std::optional<double> order_in_doubt;     ///< the first instant where it matters which impact is the first
  bool is_unclear_by_kinks{}, has_fast_kinks{};
  std::size_t hidden_kinks{};
  bool kinks_in_doubt{};      ///< the side of one is unknown for a while: errors hold what that may move
  bool begins_beside_kink{};  ///< whose side doubles do not tell, but the digits that were typed
  std::optional<double> unclear_from;  ///< the first where there are more ways than two orders
  std::optional<Stop> stop;
  /// `event` when stopped; anything but that and reached_end is a failure.
  Ending ending{Ending::reached_end};
  double t{};                              ///< how far it came
  std::vector<double> y;                   ///< the state there, before an impact that ends the motion
  std::vector<ConservedRecord> conserved;  ///< of a reference, by some of its rows
  std::vector<double> changes;             ///< of what is conserved (conserved_changes in drift.hpp)
  std::vector<ConstraintRecord> constraints;
  Method method{};
  /// gauss: whether it stepped in (q, p). It steps in (q, q') where p = dL/dq' does not determine q': for an
  /// L that is not quadratic in q', and where a coordinate has no inertia
  /// in the initial state (massless parts).
  bool symplectic{false};
  std::uint64_t steps{};
  std::uint64_t evaluations{};
  bool bounded{true};                ///< as Run::bounded, of all sections
  std::vector<double> apart_at_end;  ///< of a reference: how far each component may be where it ended
  std::vector<double> unseen;        ///< as Run::unseen, rows x 2n; empty where there is nothing
  /// As Run::accelerations, rows x n, of a reference; not a number where there is no bound.
  std::vector<double> accelerations;
  /// As in Run, rows x 2n, of a reference that stands for another motion.
  std::vector<double> apart, apart_by_rounding;
  RowsOfEvents at_events;  ///< of a computation that another one is compared with
};

}  // namespace qdot
