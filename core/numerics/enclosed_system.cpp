#include "core/numerics/enclosed_system.hpp"

#include <algorithm>
#include <array>

#include "core/numerics/constants.hpp"
#include "core/numerics/double_double_system.hpp"

namespace qdot {
namespace {

/// Beyond the rounding of sums of products of up to `largest_system` doubles.
constexpr double rounding_of_sums = 0x1p-48;

template <class T>
using Entries = std::array<T, largest_system * largest_system>;

/// The matrix as doubles with the distance of its entries from them.
struct NearbyDoubles {
  Entries<double> middle, radius;

  NearbyDoubles(std::size_t n, std::span<const Ball> m) {
    for (std::size_t i = 0; i < n * n; ++i) {
      middle[i] = m[i].value();
      radius[i] = m[i].error() + rounding_of_sums * std::abs(middle[i]);
    }
  }
};

}  // namespace

void solve_linear(std::size_t n, std::span<const Ball> m, std::span<Ball> b) noexcept {
  Entries<DoubleDouble> factors;
  std::ranges::transform(m, factors.begin(), &Ball::middle);
  RowOrder order{};
  if (!factor_linear(n, std::span(factors).first(n * n), order)) {
    std::ranges::fill(b, Ball(DoubleDouble{}, infinity));
    return;
  }
  const NearbyDoubles near(n, m);
  for (std::span<Ball> right = b; !right.empty(); right = right.subspan(n)) {
    std::array<DoubleDouble, largest_system> x;
    for (std::size_t i = 0; i < n; ++i) x[i] = right[i].middle;
    substitute_linear(n, factors, order, std::span(x).first(n));
    std::array<double, largest_system> rest, bound;
    for (std::size_t i = 0; i < n; ++i) {
      Ball sum = right[i];
      for (std::size_t j = 0; j < n; ++j) sum = sum - m[i * n + j] * Ball(x[j], 0);
      rest[i] = sum.magnitude();
    }
    bound_solution(n, {near.middle, near.radius}, rest, bound);
    for (std::size_t i = 0; i < n; ++i) right[i] = Ball(x[i], bound[i]);
  }
}

void solve_linear(std::size_t n, std::span<const Interval> m, std::span<Interval> b) noexcept {
  Entries<Ball> matrix;
  std::ranges::transform(m, matrix.begin(), &Ball::of);
  for (std::span<Interval> right = b; !right.empty(); right = right.subspan(n)) {
    std::array<Ball, largest_system> x;
    std::ranges::transform(right.first(n), x.begin(), &Ball::of);
    solve_linear(n, std::span<const Ball>(matrix).first(n * n), std::span(x).first(n));
    for (std::size_t i = 0; i < n; ++i) right[i] = x[i].is_finite() ? x[i].interval() : Interval::whole();
  }
}

}  // namespace qdot
