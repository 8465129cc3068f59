#pragma once
// Directions in which a system moves freely: along a free v no force changes, wherever the motion starts,
//
//   sum_j v_j dg_i/dx_j = 0 identically in x, for every force g_i
//
// so that K v = 0 exactly. Numbers cannot tell that from a stiffness that cancels in every digit that is
// kept; they only tell which v to try.

#include <optional>

#include "core/steady/linearization.hpp"

namespace qdot {

/// Whether that is proven of a direction near v, whose components have ratios that are short fractions or
/// quotients of two of the constants: (1, 1) of two carts, (r2, -r1) of two geared wheels. v holds every
/// coordinate that is left in the statics, or the first ones of them.
[[nodiscard]] bool is_free(const Statics& statics, const std::vector<Ball>& constants, const Shape& v);

/// lambda of a direction near v, found in the same way, along which nothing is damped:
///
///   D v = 0 and K v = lambda M v,  so that s = i sqrt(lambda) is an eigenvalue whose real part is 0,
///   exactly,
///
/// identically in x, or at x = 0 where that is the place. None where that is not proven.
[[nodiscard]] std::optional<Ball> undamped_along(const Linearization& at, const Shape& v);

/// No force is other than linear in x, x' and x'': small motions are all motions.
[[nodiscard]] bool has_linear_equations(const Statics& statics);

}  // namespace qdot
