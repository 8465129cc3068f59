#pragma once
// The errors of a motion's events and of its stop, from those of its rows and from other
// computations' states at its events.

#include <optional>
#include <span>
#include <vector>

#include "core/motion/errors_at_events.hpp"
#include "core/motion/event_errors.hpp"
#include "core/motion/motion_check.hpp"

namespace qdot {

/// What is known of the error of each row that was compared.
struct ErrorsOfRows {
  const std::vector<double>& stated;  ///< rows x 2n; they do not fall from row to row
  double doubt{};                     ///< the part of each column's magnitude that is in them
  std::span<const double> scale{};    ///< the largest magnitude of each column
};

/// A computation's approach, and where the true motion is then: by what that computation is off itself, or by
/// another one that tells.
struct ApproachAsTold {
  ApproachRecord approach;
  StateAsTold told;
  std::vector<double> stated{};  ///< the errors of the last row before it
};

/// The computation that approaches are taken from: the first of the others that knows its own error, or else
/// the motion itself.
[[nodiscard]] const Simulation& computation_that_tells(const ComputedMotion& motion,
                                                       std::span<const Simulation> others);

class EventComparison {
 public:
  /// Keeps references.
  EventComparison(const ComputedMotion& motion, const std::vector<Simulation>& others,
                  const ErrorsOfRows& errors, RowsAtImpacts& at_impacts);

  /// Of each event; none where it may not happen, or after the last row.
  [[nodiscard]] std::vector<std::optional<EventError>> of_events();
  /// Where the true motion nearly meets what would change its way, in order of time.
  [[nodiscard]] std::vector<ApproachAsTold> approaches();
  /// The same of events that are reported only.
  [[nodiscard]] std::vector<ApproachAsTold> near_events();
  /// None where there is no stop, or where no other computation has it.
  [[nodiscard]] std::optional<EventError> of_stop();

 private:
  void doubt_neighbours(std::vector<std::optional<EventError>>& errors) const;
  static void share_with_cause(std::vector<std::optional<EventError>>& errors);
  struct OfState {
    std::vector<double> errors;  ///< empty after the last row
    bool are_of_it{};            ///< or of later rows
  };
  [[nodiscard]] OfState errors_at(const EventRecord& event);
  [[nodiscard]] bool is_passed_against(const ApproachRecord& approach);
  void add_told(const ApproachRecord& approach, std::vector<ApproachAsTold>& all);
  void widen_for_others(const Approach::Others& others, std::vector<StateAsTold>& told) const;
  [[nodiscard]] std::size_t rows() const { return errors_.stated.size() / scale_.size(); }
  [[nodiscard]] std::span<const double> row(std::size_t i) const;
  [[nodiscard]] std::vector<double> rows_before(double t);
  [[nodiscard]] std::vector<double> some_rows_after(double t) const;
  [[nodiscard]] double own_time() const;
  [[nodiscard]] bool is_impact(const std::string& name) const;
  [[nodiscard]] bool is_small(std::span<const double> errors) const;
  [[nodiscard]] std::optional<EventError> of_accumulation(std::span<const double> of_state,
                                                          std::span<const double> of_rows);
  [[nodiscard]] std::optional<EventError> of_breaking_impact(std::span<const double> of_state,
                                                             double at_least);
  [[nodiscard]] std::optional<double> accumulation_error(std::span<const double> of_state);

  const ComputedMotion& motion_;
  const std::vector<Simulation>& others_;
  ErrorsOfRows errors_;
  std::span<const double> scale_;
  ErrorsAtEvents at_events_;
  EventErrors of_state_;
  std::size_t next_row_{};       ///< after the event that was looked at last
  std::vector<double> reached_;  ///< the largest magnitude of each column up to there
};

}  // namespace qdot
