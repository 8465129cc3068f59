#include "core/numerics/root_quadrature.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/numerics/constants.hpp"

namespace qdot {
namespace {

/// g and the bounds of |sqrt(p/q) - g|.
struct RootApproximation {
  std::vector<double> g;
  Interval range = Interval::whole();  ///< of sqrt(p/q)
  Interval rounding, truncation;       ///< +- the bounds; the whole line where there is none
};

Interval symmetric(const Interval& size) { return {-size.magnitude(), size.magnitude()}; }

/// All values of the polynomial for |t| <= 1.
Interval range_of(const EnclosedPolynomial& f) {
  Interval rest(0);
  for (std::size_t k = 1; k < f.coefficients.size(); ++k) rest = rest + symmetric(f.coefficients[k]);
  return intersection(f.coefficients[0] + rest, f.range);
}

/// sqrt(p/q) to the order of its coefficients, in doubles.
std::vector<double> rounded_root(std::span<const Interval> p, std::span<const Interval> q) {
  const std::size_t n = p.size() - 1;
  std::vector<double> ratio(n), g(n);
  for (std::size_t k = 0; k < n; ++k) {
    double sum = p[k].middle();
    for (std::size_t j = 1; j <= k; ++j) sum -= q[j].middle() * ratio[k - j];
    ratio[k] = sum / q[0].middle();
    double rest = ratio[k];
    for (std::size_t j = 1; j < k; ++j) rest -= g[j] * g[k - j];
    g[k] = k == 0 ? std::sqrt(ratio[0]) : rest / (2 * g[0]);
  }
  return g;
}

/// Numbers with the errors that they have at most: sums of products without the branches of Interval's.
/// Source: Rump, Fast and parallel interval arithmetic, BIT 39 (1999).
struct Balls {
  std::vector<double> middle, radius;
};

Balls balls_of(std::span<const Interval> intervals) {
  Balls balls;
  for (const Interval& x : intervals) {
    balls.middle.push_back(x.middle());
    balls.radius.push_back((x - Interval(x.middle())).magnitude());
  }
  return balls;
}

/// A sum of so many products, in any order, is within this much of the sum of their magnitudes (Higham,
/// Accuracy and Stability of Numerical Algorithms, 2nd ed., section 3.1; one term more than there is makes up
/// for gamma).
double dot_rounding(std::size_t products) { return 0x1p-53 * static_cast<double>(products + 2); }
constexpr double underflow = 1e-300;

/// Largest absolute values of the coefficients of p - a b. Radii are rounded themselves, which the last
/// factor covers.
std::vector<double> defect_of(const Balls& p, const Balls& a, const Balls& b) {
  constexpr double radius_rounding = 1 + 0x1p-40;
  std::vector<double> result(a.middle.size() + b.middle.size() - 1);
  for (std::size_t k = 0; k < result.size(); ++k) {
    const bool has_p = k < p.middle.size();
    double sum = has_p ? p.middle[k] : 0, size = std::abs(sum), radius = has_p ? p.radius[k] : 0;
    const std::size_t first = k < b.middle.size() ? 0 : k - b.middle.size() + 1;
    for (std::size_t i = first; i <= k && i < a.middle.size(); ++i) {
      const double x = a.middle[i], y = b.middle[k - i];
      sum -= x * y;
      size += std::abs(x * y);
      radius += std::abs(x) * b.radius[k - i] + a.radius[i] * (std::abs(y) + b.radius[k - i]);
    }
    result[k] = (std::abs(sum) + radius + dot_rounding(k + 1) * size) * radius_rounding + underflow;
  }
  return result;
}

/// g^2, rounded.
Balls square_of(const std::vector<double>& g) {
  const std::size_t n = g.size();
  Balls square{std::vector<double>(2 * n - 1), std::vector<double>(2 * n - 1)};
  for (std::size_t k = 0; k < 2 * n - 1; ++k) {
    double sum = 0, size = 0;
    for (std::size_t i = k < n ? 0 : k - n + 1; i <= k && i < n; ++i) {
      sum += g[i] * g[k - i];
      size += std::abs(g[i] * g[k - i]);
    }
    square.middle[k] = sum;
    square.radius[k] = dot_rounding(k + 1) * size + underflow;
  }
  return square;
}

RootApproximation approximate_root(const EnclosedPolynomial& p, const EnclosedPolynomial& q) {
  RootApproximation root;
  root.rounding = root.truncation = Interval::whole();
  const Interval numerator = range_of(p), denominator = range_of(q);
  if (!(numerator.lower >= 0) || !(denominator.lower > 0) || !numerator.is_finite()) return root;
  root.range = sqrt(numerator / denominator);
  root.g = rounded_root(p.coefficients, q.coefficients);
  if (!std::ranges::all_of(root.g, [](double x) { return std::isfinite(x); })) return root;
  const std::size_t n = root.g.size();
  const std::vector<double> defect =
      defect_of(balls_of(p.coefficients), balls_of(q.coefficients), square_of(root.g));
  Interval low(0), high(0), lesser(root.g[0]);
  for (std::size_t k = 0; k < defect.size(); ++k) {
    (k < n ? low : high) = (k < n ? low : high) + Interval(defect[k]);
  }
  for (std::size_t k = 1; k < n; ++k) lesser = lesser - Interval(std::abs(root.g[k]));
  const Interval divisor =
      Interval(denominator.lower) * (Interval(root.range.lower) + Interval(std::max(lesser.lower, 0.0)));
  root.rounding = symmetric(low / divisor);
  root.truncation = symmetric(high / divisor);
  return root;
}

/// length: of the measure over which the error is integrated.
EnclosedIntegral with_bounds(const RootApproximation& root, const Interval& sum, const Interval& length) {
  const Interval by_range = length * root.range;
  const Interval by_series = sum + length * (root.rounding + root.truncation);
  const double truncation = 2 * (length * root.truncation).magnitude();
  if (by_series.width() < by_range.width()) return {intersection(by_series, by_range), truncation};
  return {by_range, std::min(truncation, by_range.is_finite() ? by_range.width() : infinity)};
}

}  // namespace

EnclosedIntegral integral_of_root(const EnclosedPolynomial& p, const EnclosedPolynomial& q,
                                  const Interval& from, const Interval& to) {
  const RootApproximation root = approximate_root(p, q);
  Interval sum(0), left = from, right = to;
  for (std::size_t k = 0; k < root.g.size(); ++k) {
    sum = sum + Interval(root.g[k]) * ((right - left) / Interval(static_cast<double>(k + 1)));
    left = left * from;
    right = right * to;
  }
  return with_bounds(root, sum, to - from);
}

EnclosedIntegral integral_of_singular_root(const EnclosedPolynomial& p, const EnclosedPolynomial& q,
                                           const Interval& to) {
  const RootApproximation root = approximate_root(p, q);
  Interval sum(0), power(1);
  for (std::size_t k = 0; k < root.g.size(); ++k) {
    sum = sum + Interval(root.g[k]) * power / Interval(static_cast<double>(k) + 0.5);
    power = power * to;
  }
  const Interval start = sqrt(to);
  return with_bounds(root, sum * start, Interval(2) * start);
}

}  // namespace qdot
