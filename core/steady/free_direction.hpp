#pragma once
// Directions in which a system moves freely: along a free v no force changes, wherever the motion starts,
//
//   sum_j v_j dg_i/dx_j = 0 identically in x, for every force g_i
//
// so that K v = 0 exactly. Numbers cannot tell that from a stiffness that cancels in every digit that is
// kept; they only tell which v to try.

#include "core/steady/linearization.hpp"

namespace qdot {

/// Whether that is proven of a direction near v, whose components have ratios that are short fractions or
/// quotients of two of the constants: (1, 1) of two carts, (r2, -r1) of two geared wheels. v holds every
/// coordinate that is left in the statics, or the first ones of them.
[[nodiscard]] bool is_free(const Statics& statics, const std::vector<Ball>& constants, const Shape& v);

}  // namespace qdot
