#pragma once
// M x = b in balls, for the few unknowns of a mechanical system.

#include <optional>
#include <vector>

#include "core/numerics/ball.hpp"

namespace qdot {

/// The solution, by elimination; none where a pivot may be zero. M by rows.
[[nodiscard]] std::optional<std::vector<Ball>> solved(std::vector<std::vector<Ball>> m, std::vector<Ball> b);

}  // namespace qdot
