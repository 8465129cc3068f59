#pragma once
// Combinations of equations, sum c_i g_i with numbers c_i, in which terms that the equations share cancel:
// g_1 = u^3 - u + v and g_2 = u^3 - u - v vanish together only where g_1 - g_2 = 2 v does. Enclosed by
// themselves, g_1 and g_2 may both vanish all along u^3 = v; their difference tells at once.

#include <span>
#include <vector>

#include "core/expr/expression.hpp"

namespace qdot {

/// Of two or three equations, the few with the fewest terms; none for more equations, and where nothing
/// cancels.
[[nodiscard]] std::vector<Expression> combinations(std::span<const Expression> equations);

}  // namespace qdot
