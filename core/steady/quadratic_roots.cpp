#include "core/steady/quadratic_roots.hpp"

#include <algorithm>

namespace qdot {
namespace {

using Outcome = QuadraticRoots::Outcome;

/// The root of what rounding may have made a little negative.
Interval root_of(const Interval& x) { return sqrt(Interval(std::max(x.lower, 0.0), x.upper)); }

/// c0 + c2 u^2 = 0.
QuadraticRoots opposite_roots(std::span<const Interval> c) {
  const Interval square = -c[0] / c[2];
  if (square.upper < 0) return {Outcome::negative_square, {}, square.middle()};
  const Interval root = root_of(square);
  if (root.lower == 0) return {Outcome::found, {hull(root, -root)}, 0, root.upper > 0};
  return {Outcome::found, {root, -root}, 0};
}

}  // namespace

QuadraticRoots quadratic_roots(std::span<const Interval> c, std::span<const Interval> near) {
  if (!std::ranges::all_of(c, &Interval::is_finite)) return {Outcome::undefined, {}, 0};
  const bool linear = is_zero(c[2]);
  if (near[linear ? 1 : 2].contains(0.0)) return {Outcome::at_infinity, {}, 0};
  if (linear) return {Outcome::found, {-c[0] / c[1]}, 0};
  if (is_zero(c[1])) return opposite_roots(c);
  const Interval discriminant = square(c[1]) - Interval(4) * c[2] * c[0];
  if (discriminant.upper < 0) return {Outcome::not_real, {}, 0};
  const Interval root = root_of(discriminant);
  const Interval one = (-c[1] - root) / (Interval(2) * c[2]), other = (-c[1] + root) / (Interval(2) * c[2]);
  if (discriminant.lower <= 0) return {Outcome::found, {hull(one, other)}, 0, discriminant.upper > 0};
  if (c[1].contains(0.0)) return {Outcome::found, {one, other}, 0};
  const Interval q = (c[1].lower > 0 ? -c[1] - root : -c[1] + root) / Interval(2);
  return {Outcome::found, {q / c[2], c[0] / q}, 0};
}

}  // namespace qdot
