#pragma once
// The error of a motion, measured: the ladder.
//
// A local tolerance says nothing of the error of the answer, which is larger by a factor that depends on the
// motion, from ten to a million. So a motion is computed twice, the second time a hundred times tighter and
// by another method or order; where the second is much more accurate, the difference of the two is the error
// of the first. The returned motion is the first, and its error is twice the largest difference met up to
// each instant (row_errors.hpp), and what the second may be off by. The second has parameters and initial
// values changed in their last bits, so that a difference is not small by chance, and what the motion makes
// of that change and of the second's own steps counts (core/integrate/separation.hpp): it may be as large as
// the first one's error, and of the other sign. Where both are as tight as double precision allows, what
// rounding does to the motion, that of the numbers that were typed included, is measured in double-doubles
// (extended_motion.hpp, extended_impacts.hpp, extended_kinks.hpp). A motion that cannot be followed so, or
// not to its end, is computed a third time, from the other side. Where the true motion may go another way
// than all of these, it is computed on that, too (other_ways.hpp).
//
// Method gauss has a step in place of tolerances:
// it is checked by the tightest run there is, and does not climb.
//
// A wanted error is reached by climbing: the error at one tolerance tells the next one to try, until the
// wanted error is met, the allowed work is spent, or the last rung is reached. A check that shows early that
// its motion does not meet it is given up (error_growth.hpp). And where a motion is so far below what is
// wanted that rounding hides its error, a looser one is returned whose error the same check tells: more
// digits would cost several times as much.

#include <optional>
#include <string>
#include <vector>

#include "core/motion/simulation.hpp"

namespace qdot {

/// What is asked for beside the motion.
struct AccuracyGoal {
  enum class Kind {
    tolerances,  ///< the request's method and tolerances; the error is measured
    absolute,    ///< error <= value in every column's SI unit
    relative,    ///< error <= value times the column's largest magnitude
    work         ///< the least error for at most `evaluations` evaluations in all
  };
  Kind kind{Kind::tolerances};
  double value{};
  std::uint64_t evaluations{};
  bool verify{true};  ///< false: one run, no estimate; for tolerances only
};

struct MeasuredSimulation {
  Simulation simulation;
  Tolerances tolerances;  ///< of the run that is returned; not of gauss
  /// Of each coordinate and velocity, over the returned rows; empty when it could not be measured: `reason`.
  std::vector<double> max_abs_error;
  /// Of the times of the events and of the stop, in s; no value where the motion grazes, or beyond the last
  /// row.
  std::vector<std::optional<double>> event_errors;
  std::optional<double> stop_error;
  /// The returned instants that are at an impact to within its error: their rows are on one side of it, and
  /// whether the motion is there is not known.
  std::vector<double> at_impacts;
  /// The first returned instant where the error passes 1e-3 of a column's largest magnitude.
  std::optional<double> horizon;
  std::optional<bool> meets_request;  ///< no value where no error was wanted
  std::string reason;                 ///< why the error is not known, or not met
  std::string events_in_doubt;        ///< another computation has more or fewer of them; empty: none has
  /// Whether nothing lies hidden between the places that the computations looked at: every step of all of
  /// them has a bound of its defect. An error without it is what the places looked at say.
  bool bounded{false};
  Method verified_by{};
  std::uint64_t evaluations{};  ///< of all runs
};

/// Method taylor is replaced by bdf where damping is strong; Simulation::method says which one was used. For
/// goals other than tolerances the request's tolerances are ignored. Throws std::invalid_argument for gauss
/// with such a goal.
[[nodiscard]] MeasuredSimulation simulate_with_error(const Dynamics& dynamics,
                                                     const SimulationRequest& request,
                                                     const AccuracyGoal& goal);

}  // namespace qdot
