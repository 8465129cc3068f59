#pragma once
// Where along one coordinate a steady value of an unknown exists: between the positions at which the
// polynomial c0 + c1 u + c2 u^2 of core/steady/steady_polynomial.hpp gains or loses a root in u's domain,
//   c2 = 0 (c1 = 0 where c2 vanishes): a root goes to infinity;  c1^2 = 4 c0 c2: two roots meet;
//   c0 + c1 b + c2 b^2 = 0: a root passes the end b of the domain,
// all of them found (core/numerics/root_isolation.hpp), one position between each two tested.

#include <optional>
#include <vector>

#include "core/numerics/interval.hpp"
#include "core/steady/steady_polynomial.hpp"

namespace qdot {

/// Positions of the one coordinate for which a value exists.
struct SolvableRange {
  double from{}, to{};  ///< an angle's `from` is in (-pi, pi], `to` above it, perhaps beyond pi
  double from_error{}, to_error{};
  bool from_included{}, to_included{};
};

/// Ascending. No value for several coordinates or forces, for forces that are no such polynomials of u, and
/// where the search was given up.
[[nodiscard]] std::optional<std::vector<SolvableRange>> solvable_ranges(const SteadyPolynomial& polynomial,
                                                                        std::span<const Interval> constants,
                                                                        const Domain& of_unknown,
                                                                        const Domain& of_position);

}  // namespace qdot
