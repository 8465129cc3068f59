#pragma once
// One run of a motion and its error, measured by others (ladder.hpp).

#include <cstdint>
#include <optional>
#include <vector>

#include "core/motion/accuracy_goal.hpp"
#include "core/motion/dense_grid.hpp"
#include "core/motion/measured_simulation.hpp"
#include "core/motion/motion_check.hpp"
#include "core/motion/motion_comparison.hpp"
#include "core/motion/other_ways.hpp"

namespace qdot {

class Measurement {
 public:
  /// Keeps the references.
  Measurement(const Dynamics& dynamics, const SimulationRequest& request, const AccuracyGoal& goal);

  /// A run with these tolerances, whose error is not known yet. Where a goal decides them, none hides the
  /// motion: atol <= rtol size, of the start and of what resolve_columns() found.
  void take(Tolerances tolerances);
  /// Its error, or why there is none. A check that shows early that the run does not do is given up where
  /// that is allowed: there is only expected_excess() then.
  enum class GivesUp { never, where_it_pays };
  void measure(GivesUp gives_up);

  [[nodiscard]] MeasuredSimulation& result() { return result_; }
  /// Whether the columns without a digit are those of something at rest, off by rounding alone.
  [[nodiscard]] bool rests_within_rounding() const;
  /// The largest error in units of what is wanted; 1 is met.
  [[nodiscard]] double excess() const { return excess(result_.max_abs_error); }
  [[nodiscard]] std::optional<double> expected_excess() const { return expected_excess_; }
  /// Of columns that are to be known relative to their size, and are not, because atol hides them: from now
  /// on it does not. Returns how many times it has been too large, at least 1.
  double resolve_columns();
  /// What is conserved has changed.
  [[nodiscard]] bool contradicts() const { return contradicts_; }
  /// Round-off was not measured for lack of work.
  [[nodiscard]] bool has_doubt() const { return doubt_ > 0; }
  /// Evaluations, of all runs and of those that are still allowed.
  [[nodiscard]] std::uint64_t spent() const { return spent_; }
  [[nodiscard]] std::uint64_t left() const;
  /// Of the rows those that were asked for.
  void thin(Simulation& simulation) const;

 private:
  Simulation run(SimulationRequest request);
  [[nodiscard]] ComputedMotion motion() const;
  bool is_measured_looser(const std::vector<Simulation>& checks);
  [[nodiscard]] std::optional<Tolerances> looser_than_needed(const std::vector<Simulation>& checks) const;
  std::optional<Simulation> sharper_motion();
  bool add_check(std::vector<Simulation>& others, double direction);
  [[nodiscard]] bool can_give_up() const;
  bool can_be_checked_by(const Simulation& other);
  void state(const std::vector<Simulation>& others);
  [[nodiscard]] bool may_reach_end() const;
  void note_impacts_at_end();
  void note_other_conditions();
  void take_error_of_stop();
  [[nodiscard]] RowComparison with_other_ways(const RowComparison& without, std::vector<Simulation> others,
                                              OtherWays ways);
  [[nodiscard]] std::vector<double> wanted() const;
  void forgive_rounding_of_zeros(const std::vector<double>& error, std::vector<double>& wanted) const;
  [[nodiscard]] std::vector<double> wanted_for(const std::vector<double>& error) const;
  [[nodiscard]] double excess(const std::vector<double>& error) const;

  const Dynamics& dynamics_;
  const SimulationRequest& request_;
  const AccuracyGoal& goal_;
  DenseGrid grid_;
  bool is_stiff_;          ///< explicit methods are of no use
  double size_;            ///< of what steps are to resolve
  double size_from_rest_;  ///< where loose steps from zeros may have gone astray
  std::optional<EventRows> event_rows_;
  MeasuredSimulation result_;
  bool may_give_up_{false};
  std::optional<double> expected_excess_;  ///< of a motion whose check was given up
  bool contradicts_{false};
  double doubt_{};  ///< of each column: round-off that was not measured
  std::uint64_t spent_{};
};

}  // namespace qdot
