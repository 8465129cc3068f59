#pragma once
// Following a curve of solutions by its arclength.
//
// n equations F(x) = 0 in n + 1 unknowns have a curve of solutions wherever dF/dx has full rank. From a point
// with unit tangent t the next one is predicted at distance h along t
// and corrected by Newton's method across t,
//
//   [ dF/dx ] s = [ -F ]        [ dF/dx ] t' = [ 0 ]
//   [  t^T  ]     [  0 ]        [  t^T  ]      [ 1 ] ,   t' normalized: the tangent there,
//
// which passes folds, where no unknown serves as a parameter. h grows while this works and is halved where it
// does not. Source: E. L. Allgower, K. Georg, Introduction to Numerical Continuation Methods, SIAM 2003,
// chapters 2, 6.
//
// A Curve has
//   Place                                              a value of all the unknowns
//   Linearization { derivative, residual, ... }        dF/dx, n x (n + 1), F, and what else is known there
//   std::optional<Linearization> linearized(place)     no value where F has none
//   std::optional<Place> moved(place, step)            no value where the curve is left
// and may scale the unknowns differently at every place, as moved() understands them.

#include <Eigen/Core>
#include <algorithm>
#include <optional>
#include <utility>

namespace qdot {

/// s and t' of the equations above.
[[nodiscard]] Eigen::VectorXd correction_across(const Eigen::VectorXd& direction,
                                                const Eigen::MatrixXd& derivative,
                                                const Eigen::VectorXd& residual);
[[nodiscard]] Eigen::VectorXd tangent_towards(const Eigen::VectorXd& direction,
                                              const Eigen::MatrixXd& derivative);

/// How near the origin is to the straight piece between two points:
/// whether a place lies on a curve that was followed already.
[[nodiscard]] double distance_to_piece(const Eigen::VectorXd& begin, const Eigen::VectorXd& end);

template <class Curve>
struct CurvePoint {
  typename Curve::Place at;
  typename Curve::Linearization linearization;
  Eigen::VectorXd tangent;  ///< of length 1
};

/// A point counts as on the curve after a correction shorter than `accuracy`,
/// or one that rounding keeps from getting shorter.
struct Corrections {
  int most{};
  double accuracy{};
};

struct Advances {
  double first{}, least{}, largest{};  ///< arclength from a point to the next
  double least_cosine{};               ///< between the tangents of neighbours
  int most_points{};
};

/// The point of the curve nearest to `at` across `direction`, in which its tangent points. No value where
/// Newton's method does not converge.
template <class Curve>
[[nodiscard]] std::optional<CurvePoint<Curve>> corrected(Curve& curve, typename Curve::Place at,
                                                         const Eigen::VectorXd& direction,
                                                         const Corrections& corrections) {
  constexpr double rounding_level = 1e-10;
  double last = 1;
  for (int i = 0; i < corrections.most; ++i) {
    auto here = curve.linearized(at);
    if (!here) return std::nullopt;
    const Eigen::VectorXd step = correction_across(direction, here->derivative, here->residual);
    const double length = step.norm();
    if (!(length < 1)) return std::nullopt;
    if (length < corrections.accuracy || (length < rounding_level && length > 0.3 * last)) {
      Eigen::VectorXd tangent = tangent_towards(direction, here->derivative);
      return CurvePoint<Curve>{std::move(at), std::move(*here), std::move(tangent)};
    }
    auto next = curve.moved(at, step);
    if (!next) return std::nullopt;
    at = std::move(*next);
    last = length;
  }
  return std::nullopt;
}

/// Follows the curve from `last` along its tangent, until it is left, no advance succeeds or `visit` says so.
/// admits(point) says whether a point belongs to what is followed;
/// visit(last, next, advance) says whether to go on.
template <class Curve, class Admits, class Visit>
void follow_curve(Curve& curve, CurvePoint<Curve> last, const Corrections& corrections,
                  const Advances& advances, const Admits& admits, const Visit& visit) {
  double advance = advances.first;
  for (int points = 0; points < advances.most_points;) {
    const auto guess = curve.moved(last.at, advance * last.tangent);
    if (!guess) return;
    auto next = corrected(curve, *guess, last.tangent, corrections);
    if (!next || !admits(*next) || next->tangent.dot(last.tangent) < advances.least_cosine) {
      advance /= 2;
      if (advance < advances.least) return;
      continue;
    }
    if (!visit(last, *next, advance)) return;
    last = std::move(*next);
    advance = std::min(1.5 * advance, advances.largest);
    ++points;
  }
}

}  // namespace qdot
