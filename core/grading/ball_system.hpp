#pragma once
// M x = b in balls, for the few unknowns of a mechanical system.

#include <optional>
#include <vector>

#include "core/numerics/ball.hpp"

namespace qdot {

/// The solution, by elimination; none where a pivot may be zero. M by rows.
[[nodiscard]] std::optional<std::vector<Ball>> solved(std::vector<std::vector<Ball>> m, std::vector<Ball> b);

/// By rows; none where a pivot may be zero.
[[nodiscard]] std::optional<std::vector<std::vector<Ball>>> inverted(const std::vector<std::vector<Ball>>& m);

/// K - x of Krawczyk's operator on the box of `radius` about x,
///
///   K - x = -Y r(x) + (1 - Y dr/dx(X)) (X - x),
///
/// with Y near the inverse of dr/dx; none unless it lies inside of X - x, so that r has a root in K.
/// Source: Neumaier, Interval Methods for Systems of Equations (1990), theorem 5.1.8.
[[nodiscard]] std::optional<std::vector<Ball>> krawczyk_image(
    const std::vector<std::vector<Ball>>& inverse, const std::vector<Ball>& residuals,
    const std::vector<std::vector<Ball>>& slopes_in_box, double radius);

[[nodiscard]] std::vector<std::vector<Ball>> transposed(const std::vector<std::vector<Ball>>& m);

/// Whether m x = 0 has no solution but 0: every column has a pivot that is not zero. m may have more rows.
[[nodiscard]] bool has_full_rank(std::vector<std::vector<Ball>> m, std::size_t columns);

/// Whether elimination comes to a column of nothing, to 1e-20 of the largest entry.
[[nodiscard]] bool is_singular(std::vector<std::vector<Ball>> m);

}  // namespace qdot
