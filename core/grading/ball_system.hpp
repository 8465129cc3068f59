#pragma once
// M x = b in balls, for the few unknowns of a mechanical system.

#include <optional>
#include <vector>

#include "core/numerics/ball.hpp"

namespace qdot {

/// The solution, by elimination; none where a pivot may be zero. M by rows.
[[nodiscard]] std::optional<std::vector<Ball>> solved(std::vector<std::vector<Ball>> m, std::vector<Ball> b);

[[nodiscard]] std::vector<std::vector<Ball>> transposed(const std::vector<std::vector<Ball>>& m);

/// Whether elimination comes to a column of nothing, to 1e-20 of the largest entry.
[[nodiscard]] bool is_singular(std::vector<std::vector<Ball>> m);

}  // namespace qdot
