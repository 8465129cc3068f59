#pragma once
// The nearest place in one direction where F(x) = h - U(x) vanishes, found by looking at whole pieces of the
// coordinate at a time, so that none is missed, however nearly F touches zero.
//
// On a piece [p, q] with F(p) > 0, enclosures (energy_balance.hpp) decide:
//   A is not proven to be positive                      -> a shorter piece
//   F > 0 on all of it, or F rises                      -> nothing here, go on with a longer piece
//   F falls, or is concave (U'' > 0), and F(q) > 0      -> nothing here
//   F falls, or is concave, and F(q) < 0                -> one zero: interval Newton
//   F is convex (U'' < 0) with its least value at c     -> the sign of F(c) says which of these it is
//   none of them can be told                            -> a shorter piece
// Source: Moore, Kearfott, Cloud, Introduction to Interval Analysis (2009), chapters 8 and 11.

#include <optional>

#include "core/mechanics/scene.hpp"
#include "core/turning/energy_balance.hpp"

namespace qdot {

enum class Direction { down = -1, up = 1 };

struct MotionBound {
  enum class Kind {
    turning,     ///< F changes sign: the motion turns
    asymptote,   ///< F cannot be told from 0 at a maximum of U: approached for ever, or turned at, or passed
    full_turn,   ///< F > 0 over one turn of an angle
    unbounded,   ///< F > 0 as far as the numbers go
    domain_end,  ///< F > 0 up to the end of the coordinate's domain
    fall,        ///< F > 0 up to a pole of U, towards which F grows as far as numbers tell
    no_value,    ///< F > 0 up to where U has no value that could be enclosed
    no_inertia,  ///< F > 0 up to where A may vanish: the speed has no bound there
    endless_inertia,  ///< F > 0 up to where A has no bound, or no value that could be enclosed
    near_end,   ///< F > 0 up to next to the end of the domain, where rounding does not tell whether it turns
    unresolved  ///< the search came no further than `place`
  };
  Kind kind{Kind::unresolved};
  Interval place{};  ///< where; for an asymptote, all of where F may vanish near the maximum
  /// A double near the place, and how far it is at most: less than a unit in the last place, if that is
  /// known.
  struct Nearest {
    double value{}, error{};
  };
  std::optional<Nearest> nearest{};
};

/// How far the coordinate goes.
struct Range {
  Domain domain;
  std::optional<double> period;  ///< U's, for an angle
};

class TurningSearch {
 public:
  /// The motion starts with F > 0 at x0 or, from rest, towards `direction`.
  TurningSearch(EnergyBalance& energy, const Range& range, Direction direction);

  [[nodiscard]] MotionBound run();

 private:
  /// What is known on the piece from p_ to q.
  struct Piece {
    double q{};
    Interval x;          ///< all of it
    Interval remaining;  ///< F
    Interval slope;      ///< g = U'
    Interval stiffness;  ///< U''
  };

  [[nodiscard]] double first_width();
  [[nodiscard]] double limit() const;
  [[nodiscard]] Piece piece(double width);
  [[nodiscard]] bool is_positive(const Piece& piece);
  [[nodiscard]] Interval remaining_at(double x);
  [[nodiscard]] Interval remaining_at_crest(const Interval& c);
  [[nodiscard]] bool rises(const Interval& slope) const;
  [[nodiscard]] bool rises_strictly(const Interval& slope) const;
  [[nodiscard]] bool falls(const Interval& slope) const;
  [[nodiscard]] Interval slope_beside_start(const Piece& piece);
  enum class Verdict { nothing, undecided, bound };
  [[nodiscard]] Verdict look(Piece piece);
  [[nodiscard]] Verdict look_at_crest(const Piece& piece);
  [[nodiscard]] Verdict look_at_end(const Piece& piece);
  [[nodiscard]] MotionBound look_beyond_resolution();
  [[nodiscard]] Interval around_what_is_singular(const Piece& from);
  [[nodiscard]] Interval around_what_has_no_inertia(const Piece& from);
  [[nodiscard]] bool grows_towards(const Piece& piece);
  [[nodiscard]] Interval rest() const;  ///< all beyond p_
  [[nodiscard]] bool has_inertia_from_here();
  [[nodiscard]] bool is_free_from_here();
  [[nodiscard]] Interval narrowed(double from, double to);
  [[nodiscard]] Interval critical_point(Interval x);
  [[nodiscard]] Interval touching_range(double centre, const Interval& stiffness, const Interval& remaining);

  EnergyBalance& energy_;
  Range range_;
  double sign_;
  double p_;            ///< F > 0 from x0 to here
  Interval remaining_;  ///< F(p_)
  MotionBound bound_;
};

}  // namespace qdot
