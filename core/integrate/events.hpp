#pragma once
// Zeros of event functions g(t, y(t)), found on the dense output of each step: all of them.
//
// An event is a change of sign: g has one strict sign, later the other. Along a step g is a polynomial but
// for a bounded rest (EventFunction::series), so that its signs on the whole step are known: no zero lies
// between two places that were looked at. Where a polynomial does not tell, a shorter piece of the step
// does, down to the round-off of t; and where what values are rounded by hides the sign, as beside a
// multiple root, more digits do (EventFunction::sharp_signs), of which there are looks enough for most
// motions: a run that has spent them has not seen everything. A function that touches zero and turns back
// does not count, nor does one that passes zero and comes back by less than these digits tell; one that is
// zero at a step's end is decided when it leaves zero. A pole, such as tan has, changes sign too, but its
// values grow towards the place, and so it does not count; a jump through zero does. Where g has no value,
// as a root of what is negative, it has no sign, and what it was before does not count behind: so may it be
// any, coming from zero. A function that must have a value there ends the run before (must_have_value).
//
// A zero at t_start counts only where that is asked for: there a motion goes on after the same event has
// ended an earlier one. There g(s) = s (c_1 + c_2 s + ...), and later zeros are those of the bracket, however
// soon they come. Where g is known to be zero there, and its number is not, that number is taken from it
// until it is twice as large.
//
// Where a method's dense output is no polynomial, it is looked at through nine places of each step.

#include <array>
#include <cstddef>
#include <limits>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "core/integrate/approaches.hpp"
#include "core/integrate/run.hpp"
#include "core/integrate/step_polynomial.hpp"
#include "core/integrate/stepper.hpp"
#include "core/numerics/root.hpp"
#include "core/numerics/sign_search.hpp"

namespace qdot {

/// Zeros as near as this, in units of time_round_off, were found apart by round-off only: they are one
/// instant, the last of them.
inline constexpr double one_instant = 16;

/// How many occurrences one run reports at most; one more is an Error(too_large).
inline constexpr std::size_t most_occurrences = 50'000;

class EventSearch {
 public:
  /// Keeps the reference to the request; the run starts at its (t_start, y_start).
  explicit EventSearch(const RunRequest& request);

  /// What happened in the stepper's last step.
  struct Found {
    std::vector<EventOccurrence> events;  ///< by time; those of one instant (to round-off) by index
    bool terminal{false};                 ///< the last of them ends the run; nothing after it is reported
    std::optional<Ending> failure;        ///< the dense output failed: nothing is known about this step
  };
  [[nodiscard]] Found search(Stepper& stepper);

  /// False once the signs of a function were not found within the work allowed.
  [[nodiscard]] bool saw_everything() const { return saw_everything_; }

  /// The strict sign that each function had last before the instant t, which lies in the last step.
  [[nodiscard]] std::vector<int> signs_before(double t) const;

  /// For each function the seconds up to now in which its sign has not been told, without those in which it
  /// is exactly zero.
  [[nodiscard]] const std::vector<double>& untold() const { return untold_; }

  [[nodiscard]] std::vector<Approach> take_approaches() { return approaches_.take(); }

 private:
  static constexpr unsigned low_order = 5;  ///< cheap, and mostly enough to see that nothing happens
  static constexpr unsigned full_order = 20;
  static constexpr double of_values = 4 * std::numeric_limits<double>::epsilon();  ///< round-off of g
  static constexpr double of_doubt = 16;  ///< times what g may be away from its series

  /// A crossing: the event, and a bracket in time.
  struct Crossed {
    std::size_t event{};
    double before{}, after{};
    double hidden{};
    double untold{};
  };
  struct Zero {
    double t{};
    std::size_t event{};
    double hidden{};
    double untold{};
  };

  [[nodiscard]] bool is_quiet(std::size_t event);
  /// A piece of a step, with its sign; 0 where that is in doubt, or g has no value.
  struct Piece : SignPiece {
    bool is_nowhere{false};
    bool is_zero{false};  ///< exactly
  };
  void walk(std::size_t event, std::vector<Crossed>& crossed);
  [[nodiscard]] double hidden_before(std::size_t event, double t, int sign) const;
  void doubt_hidden(std::size_t event, std::span<const Piece> pieces);
  void look_through_rounding(std::size_t event, double h, std::vector<Piece>& pieces);
  [[nodiscard]] bool is_beside_start(std::size_t event, double from);
  [[nodiscard]] bool is_away_from_zero(std::size_t event, double from, double to);
  [[nodiscard]] bool keeps_sign(std::size_t event, double from, double to, int sign);
  [[nodiscard]] bool is_pole_between(std::size_t event, double from, double to);
  [[nodiscard]] const std::vector<double>& state_at_begin();
  [[nodiscard]] bool is_zero_at_start(std::size_t event) const;
  void forget_start(std::size_t event);
  [[nodiscard]] bool takes_sign_at_start(std::size_t event) const;
  [[nodiscard]] std::size_t changes_of_sign(std::span<const Piece> pieces);
  [[nodiscard]] std::size_t most_looks_after(std::size_t changes);
  void explore(std::size_t event, double from, double to, std::vector<Piece>& pieces);
  /// g over a piece, in the unit of its length.
  struct UnitSeries {
    std::array<double, largest_degree + 1> c{};
    std::size_t first{}, end{};  ///< the coefficients that count
    double off{};                ///< what g may be away from it
    bool is_nowhere{false};      ///< g has no value in all of the piece
    bool is_divided{false};      ///< by that unit: g is zero at t_start
    int sign_at_start{};         ///< of g at t_start, where it is too near to zero to be seen in `c`

    [[nodiscard]] std::span<const double> coefficients() const {
      return std::span(c).subspan(first, end - first);
    }
    [[nodiscard]] std::span<const double> in_whole() const { return std::span(c).first(end); }
    [[nodiscard]] bool is_finite() const;
    [[nodiscard]] bool is_zero() const;
  };
  [[nodiscard]] UnitSeries finite_series(std::size_t event, const MotionPiece& piece) const;
  [[nodiscard]] UnitSeries unit_series(std::size_t event, const MotionPiece& piece, unsigned order) const;
  [[nodiscard]] double value_at_start(std::size_t event, double of_series) const;
  [[nodiscard]] double doubt_at_start(std::size_t event, MotionPiece piece, double share,
                                      double rounding) const;
  [[nodiscard]] static bool is_seen(const UnitSeries& series);
  [[nodiscard]] bool is_in_doubt(std::size_t event, const MotionPiece& piece, const UnitSeries& series) const;
  void look_sharply(std::size_t event, double from, double to, std::vector<Piece>& pieces);
  [[nodiscard]] bool can_look_sharply(std::size_t event);
  [[nodiscard]] double rounding_of_values(std::size_t event);
  [[nodiscard]] int known_sign(std::size_t event, double time) const;
  [[nodiscard]] ApproachSearch::Along along(std::size_t event, double from, double length, int sign,
                                            const UnitSeries& series);
  [[nodiscard]] decltype(ApproachSearch::Along::sharp_slopes) sharp_slopes(std::size_t event, double begin,
                                                                           double length);
  [[nodiscard]] bool is_rounding(std::size_t event, const MotionPiece& piece, const UnitSeries& series) const;
  std::optional<double> locate(Stepper& stepper, const Crossed& crossed, Found& found);
  void look_for_approaches(const Stepper& stepper, const Found& found);
  void look_along(std::size_t event, double until, bool is_last, bool is_met);
  struct Way {  ///< along a step
    std::size_t event{};
    int sign{};
    double until{};
    bool nearly_ends{};  ///< the run, and not by this event
  };
  void look_in_pieces(const Way& way, double from, double length);
  [[nodiscard]] bool is_worth_halving(const Way& way, double length, const UnitSeries& series);
  [[nodiscard]] std::pair<UnitSeries, double> told_series(std::size_t event, double from, double length,
                                                          double shortest);
  [[nodiscard]] static bool is_told(const UnitSeries& series);
  [[nodiscard]] int sign_before(std::size_t event, bool is_met) const;
  [[nodiscard]] bool is_bounded_around(std::size_t event, const SignChange& place);
  void report(Stepper& stepper, std::vector<Zero> zeros, Found& found);
  [[nodiscard]] double value_is_wanted_until(const Found& found);
  [[nodiscard]] double value_at(std::size_t event, double t);

  const RunRequest& request_;
  StepPolynomial polynomial_;
  ApproachSearch approaches_;
  std::vector<std::size_t> near_;  ///< events to which the step may come near
  std::vector<int> signs_;  ///< the strict sign that each had last: 0 while it has had none since t_start
  std::vector<double> definite_;  ///< when it had it
  /// The signs at the last step's beginning, and what each function had in it; empty where it kept its sign.
  std::vector<int> signs_of_begin_;
  std::vector<std::vector<Piece>> pieces_;
  std::vector<double> untold_;          ///< since a sign was told last, seconds in which none was
  std::vector<double> left_at_start_;   ///< the number of what is zero there
  std::vector<double> rounding_;        ///< of its values in the step
  std::vector<bool> rounding_is_wide_;  ///< no bound of it is of use
  std::vector<double> y_;               ///< scratch
  std::size_t looks_{};                 ///< at one function in one step
  std::size_t sharp_looks_{};
  std::size_t looks_of_changes_{};     ///< in the run, beyond what a step without any may take
  std::size_t counted_{}, changes_{};  ///< of its pieces, and how often they change their sign
  std::size_t most_changes_{};
  int last_sign_{};
  bool starts_at_zero_{false};
  int sign_at_start_{};
  bool saw_everything_{true};
  double nowhere_from_{};  ///< since the step's beginning: where a function that must have a value has none
};

}  // namespace qdot
