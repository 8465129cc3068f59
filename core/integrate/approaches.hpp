#pragma once
// Where a run comes so near to an event that another computation of the same motion may decide otherwise:
// - it turns back just before a terminal event, or would have turned back just after one;
// - it ends just before an event;
// - an event that does not end the run may happen twice more, or at the run's end once.
//
// The event's function g is a polynomial along a step. At these places |g| has a minimum, or g turns beyond
// the event, and g is small beside its largest value since t_start. Whether g is also small beside the error
// of the motion is decided elsewhere (core/motion).

#include <functional>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "core/integrate/run.hpp"
#include "core/integrate/step_polynomial.hpp"
#include "core/numerics/sign_search.hpp"

namespace qdot {

/// A step's polynomials are roughly right up to this part of the step beyond its end.
inline constexpr double beyond_step = 0.5;
/// Minima of |g| below this part of the largest |g| are noted.
inline constexpr double near_zero = 0.05;

class ApproachSearch {
 public:
  /// Keeps the reference to the request.
  explicit ApproachSearch(const RunRequest& request);

  /// Whether g may come near to zero in a step where its values are roughly between `lower` and `upper`.
  /// Takes these into the largest |g|. Always false where the request asks for no approaches.
  [[nodiscard]] bool is_near(std::size_t event, double lower, double upper);

  /// The same without a change to the largest |g|.
  [[nodiscard]] bool may_come_near(std::size_t event, double lower, double upper) const;

  /// g along a piece of a step, in the unit of the piece.
  struct Along {
    std::size_t event{};
    double from{}, length{};    ///< of the piece, in seconds since the step's beginning
    int sign{};                 ///< of g before the piece
    std::span<const double> c;  ///< coefficients
    double off{};               ///< bound of the error of this polynomial
    bool is_told{true};         ///< `off` is small beside the coefficients
    bool is_rounding{false};    ///< `off` is not small, and is rounding
    /// The signs of g' between two places of the piece, from more digits than the coefficients have; empty
    /// where these do not show the signs either. Optional.
    std::function<std::vector<SignPiece>(double from, double to)> sharp_slopes{};
    /// The sign of g at a place of the piece; 0 where it is not known.
    std::function<int(double place)> known_sign{};
  };
  /// Call it for the pieces of a step in their order. `is_last`: another event ends the run after this one.
  void look(const Along& g, StepPolynomial& step, bool is_last);
  /// The same for an event that does not end the run. `sign` does not count, as g may have passed zero in the
  /// step. Turns that `known_sign` shows beyond zero are left out: both crossings were found, with errors.
  void look_at_both_sides(Along g, StepPolynomial& step, bool is_last);
  /// From here on g has no value.
  void leave(std::size_t event) { of_events_[event].slope = 0; }
  /// The event was met where the piece begins.
  void pass(const Along& g, StepPolynomial& step);

  /// g has one sign before and after the piece, and no sign that is seen within it.
  void doubt(const Along& g, StepPolynomial& step);

  /// There the run has ended in the step that was looked at last.
  void forget_after(double t) {
    std::erase_if(found_, [t](const Approach& approach) { return approach.is_hidden && approach.t > t; });
  }

  /// g was zero `from` seconds after the step's beginning, and its condition has the value `value` there.
  void ask_condition(std::size_t event, StepPolynomial& step, double from, double value);

  [[nodiscard]] std::vector<Approach> take() { return std::exchange(found_, {}); }

 private:
  struct OfEvent {
    double reach{};  ///< the largest |g|
    int slope{};     ///< the sign of |g|' at the end of the step before, or of g' where the event does not
                     ///< end the run; 0 where nothing is known
    bool is_told{true};  ///< `slope` is certain
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
