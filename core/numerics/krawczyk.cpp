#include "core/numerics/krawczyk.hpp"

#include <algorithm>
#include <cmath>

#include "core/numerics/dense_matrix.hpp"

namespace qdot {
namespace {

Eigen::Index row_at(std::size_t i) { return static_cast<Eigen::Index>(i); }

/// Of equations that are not of one size, as those that algebra has rid of denominators: each is divided by
/// the power of 2 that its slopes have, or the smaller ones would count as nothing.
Eigen::MatrixXd inverse_by_rows(Eigen::MatrixXd j) {
  Eigen::VectorXd sizes(j.rows());
  for (Eigen::Index i = 0; i < j.rows(); ++i) {
    int exponent = 0;
    (void)std::frexp(j.row(i).cwiseAbs().maxCoeff(), &exponent);
    sizes[i] = std::ldexp(1.0, -exponent);
    j.row(i) *= sizes[i];
  }
  Eigen::MatrixXd result = inverse(j);
  for (Eigen::Index i = 0; i < j.rows(); ++i) result.col(i) *= sizes[i];
  return result;
}

/// J(c)^-1 rounded; no value where it is singular or not finite.
std::optional<Eigen::MatrixXd> inverse_at(const SquareSystem& system, const Box& c) {
  const Eigen::Index n = row_at(c.size());
  Box jacobian(c.size() * c.size());
  system.jacobian(c, jacobian);
  Eigen::MatrixXd j(n, n);
  for (std::size_t k = 0; k < jacobian.size(); ++k) j(row_at(k) / n, row_at(k) % n) = jacobian[k].middle();
  if (!j.allFinite()) return std::nullopt;
  Eigen::MatrixXd result = inverse(j);
  if (!result.allFinite()) result = inverse_by_rows(j);
  if (!result.allFinite()) return std::nullopt;
  return result;
}

}  // namespace

Box values_over(const SquareSystem& system, const Box& x) {
  Box result(x.size());
  system.values(x, result);
  return result;
}

Box krawczyk(const SquareSystem& system, const Box& box) {
  const std::size_t n = box.size();
  const Box c = middle(box);
  if (!is_bounded(values_over(system, box))) return box;  // where F jumps its slopes may have a bound
  const auto y = inverse_at(system, c);
  if (!y) return box;
  const Box f = values_over(system, c);
  Box jacobian(n * n), result(n);
  system.jacobian(box, jacobian);
  const auto entry = [&](std::size_t i, std::size_t j) { return Interval((*y)(row_at(i), row_at(j))); };
  for (std::size_t i = 0; i < n; ++i) {
    result[i] = c[i];
    for (std::size_t j = 0; j < n; ++j) result[i] = result[i] - entry(i, j) * f[j];
    for (std::size_t j = 0; j < n; ++j) {
      if (box[j].width() == 0) continue;
      Interval slope(i == j ? 1.0 : 0.0);
      for (std::size_t k = 0; k < n; ++k) {  // what has no bound may stand beside 0
        if (const Interval y_ik = entry(i, k); !is_zero(y_ik)) slope = slope - y_ik * jacobian[k * n + j];
      }
      result[i] = result[i] + slope * (box[j] - c[j]);
    }
  }
  return result;
}

bool may_hold_zero(const SquareSystem& system, Box box) {
  constexpr int sweeps = 3;
  const std::size_t n = box.size();
  for (int sweep = 0; sweep < sweeps; ++sweep) {
    Box jacobian(n * n);
    system.jacobian(box, jacobian);
    for (std::size_t i = 0; i < n; ++i) {
      const Interval& slope = jacobian[i * n + i];
      if (slope.contains(0.0) || !slope.is_finite()) continue;
      Box cut = box;
      cut[i] = Interval(box[i].middle());
      const Interval value = values_over(system, cut)[i];
      if (!value.is_finite()) continue;
      box[i] = intersection(box[i], cut[i] - value / slope);
      if (is_empty(box[i])) return false;
    }
  }
  return std::ranges::all_of(values_over(system, box), [](const Interval& v) { return v.contains(0.0); });
}

std::optional<Box> newton(const SquareSystem& system, Box c) {
  for (int i = 0; i < 6; ++i) {
    const auto y = inverse_at(system, c);
    if (!y) return std::nullopt;
    const Box f = values_over(system, c);
    for (std::size_t r = 0; r < c.size(); ++r) {
      double step = 0;
      for (std::size_t k = 0; k < c.size(); ++k) step += (*y)(row_at(r), row_at(k)) * f[k].middle();
      if (!std::isfinite(step)) return std::nullopt;
      c[r] = Interval(c[r].middle() - step);
    }
  }
  return c;
}

}  // namespace qdot
