#pragma once
// The motions that equations with kinks u_j = 0 have, one for each choice of sides, seen from one place.
//
// Equations that contain |u_j| or sign(u_j) are smooth once each sign is a number s_j: 1 or -1 on a side of
// the kink and, where the motion stays on it, the s_j between them that keeps u_j = 0 (the equivalent side of
// core/dynamics/motion_builder.hpp). With its sides chosen, a motion and each u_j along it have series about
// the place (t, y), with y = (q, q') of 2n components, times in s, and u_j in the unit it has in the scene:
//
//   y_i(t + tau) = sum_k y_ik tau^k,   u_j(t + tau) = sum_k u_jk tau^k,   0 <= k <= order.
//
// They are used for so short a tau that their last two terms are below the rounding of the sum; what is cut
// off is taken to be smaller still, which is an estimate. "Told" is said of a sign that rounding cannot
// change: 0 lies outside of an interval, or of a ball with twice the digits of a double. A sign that is not
// told counts as 0.
//
// Source: Filippov, Differential Equations with Discontinuous Righthand Sides (1988), section 4.

#include <map>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "core/compile/tape_evaluator.hpp"
#include "core/dynamics/dynamics.hpp"
#include "core/numerics/ball.hpp"
#include "core/numerics/sign_search.hpp"

namespace qdot {

/// For each kink the side on which a motion is, 1 or -1, or 0 where it stays on the kink.
using Sides = std::vector<int>;
[[nodiscard]] Staying staying_on(const Sides& sides);

class SidedMotions {
 public:
  /// Of the series of y and of u_j.
  static constexpr unsigned order = 8;

  /// `resolution` [s]: what happens within so short a time counts as one instant. Keeps the reference; the
  /// model has kinks.
  SidedMotions(const Dynamics& dynamics, std::span<const double> parameters, double resolution);
  ~SidedMotions();

  [[nodiscard]] std::size_t kinks() const { return kinks_.size(); }
  [[nodiscard]] double resolution() const { return resolution_; }
  /// The model's parameters and the sides.
  [[nodiscard]] std::vector<double> parameters(const Sides& sides) const;
  /// Null where the motion cannot stay so.
  [[nodiscard]] std::shared_ptr<const KinkedMotion> motion(const Sides& sides) const;

  /// For each kink u, du/dt, du/dq, du/dq': 2 + 2n numbers. NaN where they have no values, as integration
  /// will find too.
  [[nodiscard]] std::vector<double> geometry(const Sides& sides, double t, std::span<const double> y) const;
  /// u beyond the rounding of doubles, which all computations of a motion have in common.
  [[nodiscard]] double exact_argument(std::size_t kink, const Sides& sides, double t,
                                      std::span<const double> y);

  /// Whether doubles tell u from 0.
  [[nodiscard]] bool is_told(const Sides& sides, std::size_t kink, double t, std::span<const double> y);

  /// Its sign; 0 where that is not seen in twice the digits.
  [[nodiscard]] int argument_sign(std::size_t kink, const Sides& sides, double t, std::span<const double> y);
  /// The same at a place that is known beyond doubles, as what was typed is.
  struct Typed {
    Reals parameters;
    Real t;
    Reals y;
  };
  [[nodiscard]] int argument_sign(std::size_t kink, const Sides& sides, const Typed& place);
  /// From here on what follows is of the place (t, y).
  void look_from(double t, std::span<const double> y);
  [[nodiscard]] double t() const { return t_; }
  [[nodiscard]] const std::vector<double>& y() const { return y_; }

  /// The coefficients u_jk of each kink j along the motion; none where there is no such motion.
  using Series = std::optional<std::vector<std::vector<double>>>;
  [[nodiscard]] const Series& series(const Sides& sides);
  /// The y_ik, at i (order + 1) + k, of a motion that has series().
  [[nodiscard]] const std::vector<double>& rows(const Sides& sides);
  /// The same from another state at the same instant.
  [[nodiscard]] std::optional<std::vector<double>> rows_from(const Sides& sides, std::span<const double> y);
  /// y_i' of the motion.
  [[nodiscard]] double rate(const Sides& sides, std::size_t i) { return rows(sides)[i * (order + 1) + 1]; }
  /// Whether its series tell the motion s seconds before and after t.
  [[nodiscard]] bool tells(const Sides& sides, double s);
  /// y along series about t.
  [[nodiscard]] static std::vector<double> sums_at(double s, std::span<const double> rows);

  /// Whether doubles tell u' from 0, where there is that motion.
  [[nodiscard]] bool is_slope_told(const Sides& sides, std::size_t kink);
  /// Whether they tell its slopes from 0 there: at a multiple root there is no place to be put on.
  [[nodiscard]] bool is_gradient_told(const Sides& sides, std::size_t kink);
  /// Its series, where doubles do not tell in twice the digits: 0 for what these do not tell from 0.
  [[nodiscard]] std::vector<double> told_series(const Sides& sides, std::size_t kink);
  /// Whether doubles tell that u has that sign along the rows, s seconds later.
  [[nodiscard]] bool is_told(std::size_t kink, const Sides& sides, std::span<const double> rows, double s,
                             int sign);
  /// Its signs beyond doubles along a way, rows of order + 1 terms about t(), from <= s <= to.
  [[nodiscard]] std::vector<SignPiece> argument_signs(std::size_t kink, const Sides& sides,
                                                      std::span<const double> rows, double from, double to);
  /// From when on u has the sign of its side along the motion, as far as twice the digits tell, from the
  /// place as it was typed if it was.
  [[nodiscard]] double told_after(const Sides& sides, std::size_t kink, const std::optional<Typed>& place);
  /// For how many of the `duration` seconds before t u may not have had the sign of its side.
  [[nodiscard]] double time_elsewhere(const Sides& sides, std::size_t kink, double duration);
  /// The side, -1 to 1, that is equivalent to staying on the kink; not a number where there is none.
  [[nodiscard]] double equivalent_side(const Sides& sides, std::size_t kink);

 private:
  /// The motion with given sides, ready to be looked at.
  struct Mode;
  [[nodiscard]] Mode* mode(const Sides& sides);
  [[nodiscard]] std::vector<Interval> enclosed_geometry(const Sides& sides, double t,
                                                        std::span<const double> y);
  [[nodiscard]] static std::vector<Ball> numbers(const Reals& parameters, const Sides& sides);

  const Dynamics& dynamics_;
  const Kinks& kinks_;
  std::vector<double> parameters_;
  double resolution_;
  std::map<Sides, std::unique_ptr<Mode>> modes_;
  std::optional<TapeEvaluator<Interval>> enclosed_geometry_;
  // Of the place:
  double t_{};
  std::vector<double> y_;
  std::map<Sides, Series> series_;
};

}  // namespace qdot
