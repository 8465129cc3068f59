#pragma once
// Where a run comes so near to a terminal event that another computation of the same motion may do otherwise:
// it turns back just before the event, or has met it and, had it gone on as before, would have turned back
// just after it. Where a run ends it may also be just before an event. Of an event that does not end the run
// these are places where it may happen twice more, or at the run's end once.
//
// With g along a step as a polynomial these are places where |g| has a minimum, or, past the event, where it
// turns; g is small there beside what it was since t_start. Whether it is small beside the error of the
// motion is for others to tell.

#include <functional>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "core/integrate/run.hpp"
#include "core/integrate/step_polynomial.hpp"
#include "core/numerics/sign_search.hpp"

namespace qdot {

/// Of a step: so far beyond it its polynomials still do roughly.
inline constexpr double beyond_step = 0.5;
/// Of the largest |g|: what comes nearer to zero is noted.
inline constexpr double near_zero = 0.05;

class ApproachSearch {
 public:
  /// Keeps the reference to the request.
  explicit ApproachSearch(const RunRequest& request);

  /// Whether an event's function that goes from `lower` to `upper` in a step, roughly, may come near to zero
  /// in it, or becomes larger than before. Nothing is, where nobody asks.
  [[nodiscard]] bool is_near(std::size_t event, double lower, double upper);

  /// Whether an event's function may come near to zero where it lies between these, as far as they tell.
  [[nodiscard]] bool may_come_near(std::size_t event, double lower, double upper) const;

  /// g along a piece of a step, in the unit of the piece.
  struct Along {
    std::size_t event{};
    double from{}, length{};    ///< of the piece, in seconds since the step's beginning
    int sign{};                 ///< that g has had up to there
    std::span<const double> c;  ///< coefficients
    double off{};               ///< what g may be away from it
    bool is_told{true};         ///< small beside its coefficients
    bool is_rounding{false};    ///< not told, and what it may be away is rounding
    /// The signs of g' between two places of the piece beyond the rounding of coefficients; nothing where
    /// that does not tell them. Optional.
    std::function<std::vector<SignPiece>(double from, double to)> sharp_slopes{};
    /// The sign that g is known to have at a place of the piece; 0 where it is not.
    std::function<int(double place)> known_sign{};
  };
  /// Of a step's pieces, one after the other; `is_last`: the run ends with this one, by another event.
  void look(const Along& g, StepPolynomial& step, bool is_last);
  /// The same of an event that does not end the run; g may have been met in the step: its sign does not
  /// count. Where g is known to have passed zero, both crossings are, too, and their errors tell the rest.
  void look_at_both_sides(Along g, StepPolynomial& step, bool is_last);
  /// g has no value in what follows.
  void leave(std::size_t event) { of_events_[event].slope = 0; }
  /// The event was met where the piece begins.
  void pass(const Along& g, StepPolynomial& step);

  /// g has had the same sign before and after that piece, and none that is seen in it.
  void doubt(const Along& g, StepPolynomial& step);

  /// g was zero `from` seconds after the step's beginning, where its condition has that value.
  void ask_condition(std::size_t event, StepPolynomial& step, double from, double value);

  [[nodiscard]] std::vector<Approach> take() { return std::exchange(found_, {}); }

 private:
  struct OfEvent {
    double reach{};      ///< the largest |g|
    int slope{};         ///< the sign of |g|' where the step before ended; 0 where that does not count. Of an
                         ///< event that does not end the run that of g'.
    bool is_told{true};  ///< that slope
  };
  void widen_reach(const Along& g);
  void pass_slowly(const Along& g, StepPolynomial& step);
  void add(Approach approach, StepPolynomial& step);
  static void set_rows(Approach& approach, StepPolynomial& step);
  [[nodiscard]] bool takes_own_value(Approach& approach, double beside, bool is_end) const;
  void note(const Along& g, StepPolynomial& step, double s, double value, std::optional<double> met);

  const RunRequest& request_;
  std::vector<OfEvent> of_events_;
  std::vector<Approach> found_;
};

}  // namespace qdot
