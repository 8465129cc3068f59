#pragma once
// What an error costs: one motion computed by every method at every tolerance, each compared with a reference
// of its own, a Taylor series at the last digit of double precision (bdf where damping
// is strong).
//
// The error of a trial is the largest difference from the reference over the returned rows plus the
// reference's own error, which the ladder measures (ladder.hpp): an upper bound, which settles at twice the
// reference's error where the two cannot be told apart. Work is counted in evaluations of the accelerations;
// a Taylor expansion of order p counts as p. (E. Hairer, S. P. Norsett, G. Wanner, Solving Ordinary
// Differential Equations I, 2nd ed., section II.10, has such work-precision diagrams.)

#include <optional>
#include <span>
#include <vector>

#include "core/motion/ladder.hpp"

namespace qdot {

/// One run to make.
struct Trial {
  Method method{};
  Tolerances tolerances{};  ///< not of a method with a fixed step
  double h{};               ///< s, of a method with a fixed step only
};

struct TrialResult {
  Trial trial;
  Ending ending{};
  std::vector<double> max_abs_error;  ///< of each coordinate and velocity; empty where the run failed
  double error{};                     ///< the largest of them
  std::uint64_t evaluations{};
  std::uint64_t steps{};
};

class WorkPrecision {
 public:
  /// Computes the reference; the request's method, tolerances and columns are ignored. Both arguments must
  /// outlive this. Throws what simulate() throws.
  WorkPrecision(const Dynamics& dynamics, const SimulationRequest& request);

  /// Without max_abs_error where it could not be measured; then there is nothing to compare with.
  [[nodiscard]] const MeasuredSimulation& reference() const { return reference_; }

  /// Of one method, loosest first: every power of ten in double precision's range as rtol; for gauss steps
  /// from four times the mean step of the reference down, each half as long.
  [[nodiscard]] std::vector<Trial> trials(Method method) const;

  /// A run that needs more than five times the reference's evaluations is broken off (step_limit): nobody
  /// would choose it.
  [[nodiscard]] TrialResult run(const Trial& trial);

  /// The same run once more, for those who measure its time; its evaluations are not counted.
  void repeat(const TrialResult& trial) const;

 private:
  [[nodiscard]] SimulationRequest request_of(const Trial& trial, std::uint64_t evaluations) const;

  const Dynamics& dynamics_;
  SimulationRequest request_;
  MeasuredSimulation reference_;
  std::uint64_t left_;  ///< of the evaluations that all trials together may use
};

/// Whether each trial is on the Pareto front: none that succeeded is at once as cheap and more accurate, or
/// cheaper and as accurate. `costs` in any unit, one for each trial.
[[nodiscard]] std::vector<bool> pareto_front(std::span<const TrialResult> trials,
                                             std::span<const double> costs);

/// The cheapest trial whose error is at most `wanted`.
[[nodiscard]] std::optional<std::size_t> cheapest(std::span<const TrialResult> trials,
                                                  std::span<const double> costs, double wanted);

}  // namespace qdot
