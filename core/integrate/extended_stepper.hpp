#pragma once
// A Taylor method whose state, time and grid have twice the digits of doubles, for y' = f(t, y).
//
//   y(t + s) = sum_k c_k s^k,   c_k from ExtendedSystem::expansion
//   h = min_i min((w_i / |c_i,N-1|)^(1/(N-1)), (w_i / |c_i,N|)^(1/N)),
//   w_i = atol + rtol (|y_i| + h' |y_i'|)
//
// with h' the step before, as core/integrate/taylor_stepper.hpp has it. A step whose polynomial does not obey
// the equation at its end is taken again, half as long. Where the system can tell what a step hides, it is
// no longer than what hides no more than is allowed. Where high coefficients are doubles, it is so short that
// their terms are small beside the others, and so are those of what is rounded (rounded_series.hpp). A series
// has fewer orders where its last coefficients are next to the end of the range of doubles, as beside a pulse
// of 1e-10 s, or where it is not they that hold the step. Source of the step: Jorba, Zou, Experimental
// Mathematics 14 (2005) 99, section 3.

#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "core/integrate/extended_sums.hpp"
#include "core/integrate/rounded_series.hpp"
#include "core/integrate/run.hpp"
#include "core/numerics/double_double.hpp"

namespace qdot {

/// Of y = (q, v), in seconds or by a clock whose unit is a power of two of them: near 2^-40 s for what moves
/// as fast as an electron, whose high coefficients would leave the range of doubles. By that clock all
/// functions take and give t, q and v; only `margin` has seconds.
struct ExtendedSystem {
  std::size_t dimension{};
  double unit_of_time{1};
  /// y_i(t + s) = sum_k c[i (order + 1) + k] s^k
  std::function<Evaluation(const DoubleDouble& t, std::span<const DoubleDouble> y, unsigned order,
                           std::span<DoubleDouble> c)>
      expansion{};
  /// How much the motion through (t, y) hides until t + h: a bound of h times the defect of its series, over
  /// what is allowed, at most 1 where nothing is hidden. `defect` and where nothing is allowed: as
  /// RightHandSide::defect. Optional.
  std::function<double(double t, std::span<const double> y, double h, std::span<const double> allowed,
                       std::span<double> defect)>
      hidden{};
  unsigned order_of_hidden{};  ///< of the series whose defect that is; 0: of the step's own
  /// Over the step that was looked at last: bounds of what rounding to doubles, and to double-doubles, does
  /// to each acceleration (the second half of y'). Optional.
  std::function<void(std::span<double> in_doubles, std::span<double> in_double_doubles)> rounding{};
  /// Coefficients from this order on are doubles; what is left of the sum is added up in doubles, too.
  unsigned first_in_doubles{~0U};
  /// The equations in doubles, where it is wanted what the motion makes of the rounding of those
  /// coefficients.
  RightHandSide in_doubles{};
  unsigned highest_in_doubles{~0U};  ///< order of their series
  /// The defect of the equation at the end of a step that rounding explains, relative to y'.
  double round_off{1e-28};
  /// The equations are those of the motion while it is not negative. Optional.
  std::function<double(const DoubleDouble& t, std::span<const DoubleDouble> y)> margin{};
  std::shared_ptr<const void> kept{};  ///< what the functions refer to
};

struct ExtendedRunRequest {
  DoubleDouble t_start;
  std::vector<DoubleDouble> y_start;
  std::vector<double> apart{};  ///< what y_start is off by already; empty: nothing
  DoubleDouble t_end;
  unsigned order{};
  unsigned lower_order{};  ///< taken where it allows steps as long; 0: never
  Tolerances tolerances;
  Limits limits;
};

/// Steps through a motion, and knows it anywhere in the last step. Keeps references to its arguments.
class ExtendedStepper {
 public:
  ExtendedStepper(const ExtendedSystem& system, const ExtendedRunRequest& request);

  /// To the end of the next step, at most t_end. Otherwise why no step was possible.
  [[nodiscard]] std::optional<Ending> step();

  [[nodiscard]] const DoubleDouble& t_previous() const { return t_previous_; }
  [[nodiscard]] const DoubleDouble& t() const { return t_; }
  [[nodiscard]] std::span<const DoubleDouble> y() const { return y_; }
  /// y(t) for t_previous() <= t <= t().
  void interpolate(const DoubleDouble& t, std::span<DoubleDouble> y_out) const;

  /// The polynomials of the last step in doubles.
  [[nodiscard]] MotionPiece polynomials();
  /// What the last step may hide (bounded_steps.hpp), of each component.
  [[nodiscard]] std::span<const double> hidden() const { return hidden_; }
  /// What its last terms tell that it leaves out.
  [[nodiscard]] std::span<const double> truncated();
  /// What was rounded in it. By coefficients in doubles: of |y| as much as their terms are of the others, and
  /// where that is much, so much of what rounding does to the accelerations. By the others: what rounding to
  /// double-doubles does to these and to the states.
  [[nodiscard]] std::span<const double> rounded();

  /// Whether every step up to now has a bound of what it hides.
  [[nodiscard]] bool bounded() const { return bounded_; }

  [[nodiscard]] std::uint64_t steps() const { return steps_; }
  [[nodiscard]] std::uint64_t evaluations() const { return evaluations_; }

 private:
  struct Series {
    std::vector<DoubleDouble> c;  ///< y_i(t + s) = sum_k c[i (order + 1) + k] s^k
    unsigned order{};
  };
  [[nodiscard]] std::optional<Ending> spent_limit() const;
  /// Of the highest order up to that one, each time a quarter less, that is in range.
  [[nodiscard]] std::optional<Ending> expand(const DoubleDouble& t, std::span<const DoubleDouble> y,
                                             unsigned order, Series& series);
  [[nodiscard]] unsigned order_after(double h) const;
  [[nodiscard]] bool is_in_range(const Series& series) const;
  /// Of component i, a second's worth of its own: numbers that are no share of y are for seconds.
  [[nodiscard]] double unit_of(std::size_t i) const { return i < y_.size() / 2 ? 1 : system_.unit_of_time; }
  [[nodiscard]] std::optional<Ending> unusable_state(std::span<const DoubleDouble> y) const;
  [[nodiscard]] double weight(std::size_t i) const;
  [[nodiscard]] double step_size();
  [[nodiscard]] bool doubles_are_small(double h);
  struct Terms {
    double first{}, in_doubles{};
  };
  void take_powers(double h);
  [[nodiscard]] Terms largest_terms(std::span<const DoubleDouble> c) const;
  [[nodiscard]] double log_of_step_by(unsigned k, double part = 1) const;
  /// A length up to h over which a step hides nothing; 0 where there is none.
  [[nodiscard]] double bounded_part(double h);
  void find_hidden(double h);
  [[nodiscard]] double exact_part(double h);
  [[nodiscard]] double told_part(double h);
  bool bound_rounding();
  [[nodiscard]] bool shows_forces() const;
  [[nodiscard]] bool try_step(const DoubleDouble& t);
  [[nodiscard]] bool holds_until(const DoubleDouble& h);
  [[nodiscard]] static std::span<const DoubleDouble> row(const Series& series, std::size_t i) {
    return std::span(series.c).subspan(i * (series.order + 1), series.order + 1);
  }
  [[nodiscard]] ExtendedRows rows_of(const Series& series) const {
    return {series.c.data(), series.order, system_.first_in_doubles};
  }

  const ExtendedSystem& system_;
  const ExtendedRunRequest& request_;
  unsigned order_;  ///< at most
  DoubleDouble t_previous_, t_;
  double last_step_{};
  std::vector<DoubleDouble> y_, attempt_, slopes_;
  Series coefficients_;  ///< at t_previous_: the dense output
  Series next_;          ///< at t_
  Series beyond_;        ///< at the end of the step that is tried
  std::uint64_t steps_{}, evaluations_{};
  std::optional<Ending> trouble_;
  std::vector<double> place_, allowed_, defect_;  ///< scratch
  std::vector<double> hidden_;                    ///< in the step
  std::vector<double> powers_ = std::vector<double>(order_ + 1);
  std::vector<double> rows_, truncated_, rounded_;      ///< of the last step
  std::vector<double> in_doubles_, in_double_doubles_;  ///< what rounding does in it to accelerations
  std::optional<RoundedSeries> rounded_series_;         ///< of the next step
  bool bounded_;
};

[[nodiscard]] inline bool is_before(const DoubleDouble& a, const DoubleDouble& b) {
  return a.high < b.high || (a.high == b.high && a.low < b.low);
}

}  // namespace qdot
