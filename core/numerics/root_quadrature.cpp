#include "core/numerics/root_quadrature.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/numerics/constants.hpp"

namespace qdot {
namespace {

/// g and the bounds of |sqrt(p/q) - g|.
struct RootApproximation {
  std::vector<DoubleDouble> g;
  Interval range = Interval::whole();               ///< of sqrt(p/q)
  double rounding{infinity}, truncation{infinity};  ///< infinite where there is none
};

Interval symmetric(double size) { return {-size, size}; }

/// All values of the polynomial for |t| <= 1.
Interval range_of(const EnclosedPolynomial& f) {
  Interval range = f.coefficients[0].interval();
  for (const Ball& coefficient : f.coefficients.subspan(1))
    range = range + symmetric(coefficient.interval().magnitude());
  return intersection(range, f.range);
}

/// sqrt(p/q) to the order of its coefficients.
std::vector<DoubleDouble> rounded_root(std::span<const Ball> p, std::span<const Ball> q) {
  const std::size_t n = p.size() - 1;
  std::vector<DoubleDouble> ratio(n), g(n);
  const DoubleDouble inverse = DoubleDouble(1) / q[0].middle;
  DoubleDouble half;
  for (std::size_t k = 0; k < n; ++k) {
    DoubleDouble sum = p[k].middle;
    for (std::size_t j = 1; j <= k; ++j) sum = sum - q[j].middle * ratio[k - j];
    ratio[k] = sum * inverse;
    DoubleDouble rest = ratio[k];
    for (std::size_t j = 1; 2 * j < k; ++j) rest = rest - (g[j] + g[j]) * g[k - j];
    if (k > 0 && k % 2 == 0) rest = rest - g[k / 2] * g[k / 2];
    g[k] = k == 0 ? sqrt(ratio[0]) : rest * half;
    if (k == 0) half = DoubleDouble(0.5) / g[0];
  }
  return g;
}

/// A sum of so many products of doubles, in any order, is within this much of the sum of their magnitudes
/// (Higham, Accuracy and Stability of Numerical Algorithms, 2nd ed., section 3.1; one term more than there is
/// makes up for gamma); of double-doubles the unit is 2^-104 (Joldes, Muller, Popescu, 2017).
double dot_rounding(std::size_t products, double unit) { return unit * static_cast<double>(products + 2); }
constexpr double unit_of_doubles = 0x1p-53, unit_of_double_doubles = 0x1p-102;
constexpr double underflow = 1e-290;
/// Bounds are added up in doubles that are rounded to nearest.
constexpr double bound_rounding = 1 + 0x1p-40;

/// Numbers with the errors that they have at most: sums of products without the branches of Ball's.
/// Source: Rump, Fast and parallel interval arithmetic, BIT 39 (1999).
struct Balls {
  std::vector<DoubleDouble> middle;
  std::vector<double> radius;
};

Balls balls_of(std::span<const Ball> coefficients) {
  Balls balls;
  for (const Ball& x : coefficients) {
    balls.middle.push_back(x.middle);
    balls.radius.push_back(x.radius);
  }
  return balls;
}

/// Bound of the coefficient k < n of p - a b.
double low_defect(const Balls& p, const Balls& a, const Balls& b, std::size_t k) {
  DoubleDouble sum = p.middle[k];
  double size = std::abs(sum.high), radius = p.radius[k];
  for (std::size_t i = 0; i <= k; ++i) {
    const double x = std::abs(a.middle[i].high), y = std::abs(b.middle[k - i].high);
    sum = sum - a.middle[i] * b.middle[k - i];
    size += x * y;
    radius += x * b.radius[k - i] + a.radius[i] * (y + b.radius[k - i]);
  }
  return (std::abs(sum.high) + radius + dot_rounding(k + 1, unit_of_double_doubles) * size) * bound_rounding +
         underflow;
}

/// The same for k >= n, where there is no need of more than doubles.
double high_defect(const Balls& p, const Balls& a, const Balls& b, std::size_t k) {
  const bool has_p = k < p.middle.size();
  double sum = has_p ? p.middle[k].high : 0, size = std::abs(sum), radius = has_p ? p.radius[k] : 0;
  const std::size_t first = k < b.middle.size() ? 0 : k - b.middle.size() + 1;
  for (std::size_t i = first; i <= k && i < a.middle.size(); ++i) {
    const double x = a.middle[i].high, y = b.middle[k - i].high;
    sum -= x * y;
    size += std::abs(x * y);
    radius += std::abs(x) * b.radius[k - i] + a.radius[i] * (std::abs(y) + b.radius[k - i]);
  }
  return (std::abs(sum) + radius + 3 * dot_rounding(k + 1, unit_of_doubles) * size) * bound_rounding +
         underflow;
}

/// g^2; the coefficients from g.size() on in doubles.
Balls square_of(const std::vector<DoubleDouble>& g) {
  const std::size_t n = g.size();
  Balls square{std::vector<DoubleDouble>(2 * n - 1), std::vector<double>(2 * n - 1)};
  for (std::size_t k = 0; k < 2 * n - 1; ++k) {
    DoubleDouble sum;
    double size = 0;
    for (std::size_t i = k < n ? 0 : k - n + 1; i <= k && i < n; ++i) {
      if (k < n) {
        sum = sum + g[i] * g[k - i];
      } else {
        sum.high += g[i].high * g[k - i].high;
      }
      size += std::abs(g[i].high * g[k - i].high);
    }
    square.middle[k] = sum;
    const double unit = k < n ? unit_of_double_doubles : 3 * unit_of_doubles;
    square.radius[k] = dot_rounding(k + 1, unit) * size * bound_rounding + underflow;
  }
  return square;
}

RootApproximation approximate_root(const EnclosedPolynomial& p, const EnclosedPolynomial& q) {
  RootApproximation root;
  const Interval numerator = range_of(p), denominator = range_of(q);
  if (!(numerator.lower >= 0) || !(denominator.lower > 0) || !numerator.is_finite()) return root;
  root.range = sqrt(numerator / denominator);
  root.g = rounded_root(p.coefficients, q.coefficients);
  if (!std::ranges::all_of(root.g, [](const DoubleDouble& x) { return is_finite(x); })) return root;
  const std::size_t n = root.g.size();
  const Balls p_balls = balls_of(p.coefficients), q_balls = balls_of(q.coefficients);
  const Balls square = square_of(root.g);
  Interval low(0), high(0), lesser(Ball(root.g[0], 0).interval());
  for (std::size_t k = 0; k < n; ++k) low = low + Interval(low_defect(p_balls, q_balls, square, k));
  for (std::size_t k = n; k < 3 * n - 1; ++k)
    high = high + Interval(high_defect(p_balls, q_balls, square, k));
  for (std::size_t k = 1; k < n; ++k) lesser = lesser - Interval(Ball(root.g[k], 0).magnitude());
  const Interval divisor =
      Interval(denominator.lower) * (Interval(root.range.lower) + Interval(std::max(lesser.lower, 0.0)));
  root.rounding = (low / divisor).magnitude();
  root.truncation = (high / divisor).magnitude();
  return root;
}

/// The polynomial's integral and its error over `length`, or the range where that says more.
EnclosedIntegral with_bounds(const RootApproximation& root, Ball sum, const Ball& length) {
  const double most = length.magnitude();
  const Interval by_range = length.interval() * root.range;
  sum.radius = (sum.radius + most * (root.rounding + root.truncation)) * bound_rounding;
  const double truncation = 2 * most * root.truncation;
  if (2 * sum.radius < by_range.width()) return {sum, truncation};
  return {Ball::of(by_range), std::min(truncation, by_range.is_finite() ? by_range.width() : infinity)};
}

}  // namespace

EnclosedIntegral integral_of_root(const EnclosedPolynomial& p, const EnclosedPolynomial& q, const Ball& from,
                                  const Ball& to) {
  const RootApproximation root = approximate_root(p, q);
  Ball sum, left = from, right = to;
  for (std::size_t k = 0; k < root.g.size(); ++k) {
    sum = sum + Ball(root.g[k], 0) * ((right - left) / Ball(static_cast<double>(k + 1)));
    left = left * from;
    right = right * to;
  }
  return with_bounds(root, sum, to - from);
}

}  // namespace qdot
