#pragma once
// Integration of y' = f(t, y) in values: right-hand side, sampling grid and events go in,
// a run comes out (core/integrate/integrate.hpp).

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "core/integrate/approach.hpp"
#include "core/numerics/crossing.hpp"
#include "core/numerics/evaluation.hpp"
#include "core/numerics/interval.hpp"
#include "core/numerics/pairs.hpp"
#include "core/numerics/sign_search.hpp"

namespace qdot {

enum class Method;  // methods.hpp

/// y' = f(t, y). Where f has no value, it says so by its Evaluation, and a shorter step is tried. What a
/// function throws ends the run and reaches the caller of integrate(). Values that are not finite count as
/// nonfinite even if the Evaluation is ok. f is only ever called with y finite, |y_i| <= max_magnitude and
/// t_start <= t <= t_end.
struct RightHandSide {
  std::size_t dimension{};
  std::function<Evaluation(double t, std::span<const double> y, std::span<double> derivative)> derivative{};
  /// df/dy, row-major dimension x dimension; for methods that need it.
  std::function<Evaluation(double t, std::span<const double> y, std::span<double> jacobian)> jacobian{};
  /// Taylor coefficients of the solution through (t, y): y_i(t + s) = sum_k c[i (order + 1) + k] s^k; for
  /// methods that need it.
  std::function<Evaluation(double t, std::span<const double> y, unsigned order, std::span<double> c)>
      expansion{};
  /// Bounds over 0 <= s <= h of the defect |p_i'(s) - f_i(t + s, p(s))| of the polynomials p that `expansion`
  /// gave last; infinite where there is none. Returns the largest of h defect_i / allowed_i. Where nothing is
  /// `allowed` they are the closest there are. Optional.
  std::function<double(double h, std::span<const double> allowed, std::span<double> defect)> defect{};
  /// What rounding of f may come to over the step whose defect was bounded last, a bound for each y_i' that
  /// is an acceleration: the second half of y. Optional.
  std::function<void(std::span<double> rounding)> rounding{};
  /// Moves a state that is near to it onto what all states obey: constraints, from which steps drift away by
  /// their errors. Returns whether it could. Optional; for steps by `expansion`.
  std::function<bool(double t, std::span<double> y)> project{};
  /// The same motion in canonical variables z = (q, p), of the size of y = (q, q'): z at (t, y), and z' and
  /// dz'/dz (row-major) at (t, z). A symplectic method steps in them;
  /// without them in y, where it is not symplectic.
  struct CanonicalForm {
    std::function<Evaluation(double t, std::span<const double> y, std::span<double> z)> variables{};
    std::function<Evaluation(double t, std::span<const double> z, std::span<double> derivative)> derivative{};
    std::function<Evaluation(double t, std::span<const double> z, std::span<double> jacobian)> jacobian{};
  };
  std::optional<CanonicalForm> canonical{};
};

/// A piece of a motion as polynomials: y_i(t + s) = sum_k rows[i (order + 1) + k] s^k for 0 <= s <= h.
struct MotionPiece {
  double t{};
  double h{};
  std::span<const double> rows{};
  unsigned order{};
  /// Bounds of |p_i' - f_i(t, p)| over the piece, as RightHandSide::defect gives them; empty where they are
  /// not known.
  std::span<const double> defect{};
  /// Bounds of how far f may be from what it is computed as, for the second half of y, as
  /// RightHandSide::rounding gives them; empty where they are not known.
  std::span<const double> rounding{};
};

/// Where the signs of a function are wanted, or those of its slope: from `from` to `to` in a piece of a
/// motion, down to pieces as short as `shortest`.
struct SharpLook {
  const MotionPiece& piece;
  double from{}, to{}, shortest{};
  bool is_of_slope{};
};

/// A zero of g(t, y): a change of sign, found to round-off of t. events.hpp says what counts as one.
struct EventFunction {
  std::function<double(double t, std::span<const double> y)> value{};
  /// g along a piece of a motion: `order` + 1 coefficients of a polynomial in s, order <= largest_degree
  /// (core/numerics/sign_search.hpp). Returns a bound of its distance from g over the piece, infinite where
  /// there is none, and no number where g has no value in all of the piece.
  std::function<double(const MotionPiece& piece, unsigned order, std::span<double> coefficients)> series{};
  /// What values of g at a state may be rounded by. Optional.
  std::function<double(double t, std::span<const double> y)> rounding{};
  /// Over a box of times and states; the whole line where there may be no value. Optional.
  std::function<Interval(const Interval& t, std::span<const Interval> y)> range{};
  /// In more digits than those of values; asked where these tell nothing. Optional; nothing where it does
  /// not know more, either.
  std::function<std::vector<SignPiece>(const SharpLook& look)> sharp_signs{};
  Crossing direction{Crossing::either};
  bool terminal{false};
  bool counts_at_start{false};  ///< a zero at t_start that g then leaves in its direction is one
  /// Optional: a zero counts where this is above zero.
  std::function<double(double t, std::span<const double> y)> condition{};
  int sign_at_start{0};  ///< the strict sign that g counts as having had at t_start, where that is known
  bool is_beside_zero{false};  ///< that sign is known of g itself, which is no zero, however small it is
  /// What rounding may do to g at t_start, where that is known; it is asked where g is small there.
  std::function<double()> rounding_at_start{};
  bool ends_where_hidden{false};  ///< the run ends behind a time in which the sign of g is hidden, too
  bool must_have_value{false};    ///< where g has none for a while, the run ends before it
  int sign_after_start{0};        ///< that g takes as it leaves zero at t_start, for however short a time
  bool is_zero_at_start{false};   ///< g is zero at t_start, however far from it the error of y leaves it
};

/// A step's error is held below rtol |y_i| + atol, both positive. The error of a run is larger: for adams and
/// bdf by a hundred to ten thousand times, for erk by ten to a hundred.
struct Tolerances {
  double rtol{1e-9};
  double atol{1e-12};
};

/// Bounds on the work, the same on every machine. Every 64 evaluations a run also checks whether anyone still
/// waits for its answer (core/base/work.hpp).
struct Limits {
  std::uint64_t max_steps{250'000};
  std::uint64_t max_evaluations{12'000'000};  ///< of f and of its Jacobian together
  double max_magnitude{1e150};
};

/// Two samples of how far a computation may be from the motion that it stands for (own_errors.hpp), each with
/// the signs of its components: from the motion as it is asked for, and, enlarged, from one whose numbers are
/// rounded otherwise.
struct Apart {
  std::vector<double> by_truncation{}, by_rounding{};
  std::vector<double> reached{};  ///< the largest |y_i|, of the end of a run
  double share_of_rounding{};     ///< in the first one, since it was no longer small
};
struct Originals {
  RightHandSide asked{}, rounded{};
  /// What `expansion` of each gives, to the bit, side by side. False where they have to be asked one by one.
  /// Optional.
  std::function<bool(double t, std::span<const PairOfDoubles> y, unsigned order, std::span<PairOfDoubles> c)>
      both{};
};

struct RunRequest {
  double t_start{};
  std::vector<double> y_start{};
  double t_end{};
  /// Instants at which the state is wanted: increasing, in [t_start, t_end]; t_start itself gives y_start.
  std::span<const double> grid{};
  std::vector<EventFunction> events{};
  /// Asked after each step that has reached rows, with the first of them and them: whether the run goes on.
  std::function<bool(std::size_t first, std::span<const double> rows)> goes_on{};
  Method method{};          ///< the first of them, taylor, which a system without an expansion refuses
  unsigned taylor_order{};  ///< 0: by the tolerance
  /// Others are measured by this run: steps of taylor are bounded closer, and Run::unseen counts all that
  /// they may be off by.
  bool is_reference{false};
  bool notes_approaches{false};  ///< Run::approaches are wanted
  /// The motion that a reference stands for, and one beside both, where their numbers are others; `apart` is
  /// how far it begins from them. Both need an expansion.
  const Originals* originals{};
  Apart apart{};
  Tolerances tolerances{};  ///< not of a method with a fixed step
  double h{};               ///< the fixed step; where h does not divide the span, the last one is shorter
  Limits limits{};
};

enum class Ending {
  reached_end,
  event,           ///< a terminal event
  step_limit,      ///< max_steps or max_evaluations spent, no progress in 1000 steps, or no step accepted
  nonfinite,       ///< f, or a derivative that its series needs, became infinite or undefined
  singular_mass,   ///< the mass matrix lost its inverse
  tolerance,       ///< the tolerances ask for more than double precision holds, or the span is below 1e-140
  blow_up,         ///< |y| beyond max_magnitude, or a singularity reached in t's last digits (progress.hpp)
  no_convergence,  ///< gauss: no solution found for the equations of a step; h is too long at this place
  given_up,        ///< RunRequest::goes_on said no
  undetermined     ///< nothing decides how the motion goes on: at a kink, or from coefficients in doubles
};

/// As asked for, or at a terminal event.
[[nodiscard]] constexpr bool ended_well(Ending ending) {
  return ending == Ending::reached_end || ending == Ending::event;
}

struct EventOccurrence {
  std::size_t event{};  ///< index into RunRequest::events
  double t{};
  std::vector<double> y{};
  double hidden{};  ///< no crossing: for this many seconds up to t rounding hid the sign of g
  double untold{};  ///< around a crossing: for this many seconds the signs were not known
};

struct Run {
  std::size_t rows{};                     ///< instants of the grid that were reached: those up to t
  std::vector<double> states{};           ///< rows x dimension, row-major
  std::vector<EventOccurrence> events{};  ///< in order of time, those of one instant in order of index
  Ending ending{Ending::reached_end};
  double t{};               ///< where the run ended: t_end, the event, or the last good step
  std::vector<double> y{};  ///< the state there
  std::uint64_t steps{};
  std::uint64_t evaluations{};
  /// Whether every step was accepted with a bound of its defect over its whole length: nothing lies hidden
  /// between the places where f was evaluated.
  bool bounded{false};
  /// Of a reference: all that its steps may be off by, and where they may hide something that their last
  /// coefficients do not show, how much of each component, up to each row (rows x dimension). Otherwise
  /// empty.
  std::vector<double> unseen{};
  std::vector<double> unseen_at_end{};  ///< the same where the run ended
  /// Of a reference, where y is (q, q'): for each row bounds of |q''| during the step that it lies in, not
  /// numbers where they are not known (rows x dimension/2). Otherwise empty.
  std::vector<double> accelerations{};
  /// How far the run may be from the original, where there is one, and by its rounding alone: for each row
  /// the larger of both ends of the step that it lies in (rows x dimension).
  std::vector<double> apart{}, apart_by_rounding{};
  Apart apart_at_end{};                ///< where the run ended
  std::vector<Approach> approaches{};  ///< to events, in order of time, those of one step in any order
  /// The strict sign that each event's function had last, before the instant in which the run ended; 0: none.
  std::vector<int> signs{};
  std::vector<double> untold{};  ///< for each event the seconds up to the end in which that was not seen
};

}  // namespace qdot
