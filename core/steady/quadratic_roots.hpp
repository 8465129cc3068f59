#pragma once
// The roots of c0 + c1 u + c2 u^2 = 0 in interval arithmetic, without cancellation: of the two forms of a
// root the one is taken in which -c1 and the root of the discriminant have the same sign, and the other root
// follows from u1 u2 = c0/c2. Source: Moore, Kearfott, Cloud (2009), chapter 2.

#include <span>
#include <vector>

#include "core/numerics/interval.hpp"

namespace qdot {

struct QuadraticRoots {
  enum class Outcome {
    found,
    undefined,        ///< a coefficient is not finite
    at_infinity,      ///< the leading coefficient may be zero at the place that was meant
    not_real,         ///< the discriminant is negative
    negative_square,  ///< c1 = 0, and u^2 would have to be `square`
  } outcome{};
  std::vector<Interval> values;
  double square{};
  bool may_be_two{};  ///< or none: the discriminant may be zero, and the one value holds all there are
};

/// `c`: c0, c1, c2 at a place. `near`: the same for all places that the given one may stand for.
[[nodiscard]] QuadraticRoots quadratic_roots(std::span<const Interval> c, std::span<const Interval> near);

}  // namespace qdot
