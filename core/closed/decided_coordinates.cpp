#include "core/closed/decided_coordinates.hpp"

#include <algorithm>

#include "core/numerics/dense_matrix.hpp"

namespace qdot {
namespace {

Eigen::Index index(std::size_t i) { return static_cast<Eigen::Index>(i); }

/// dg/dx of the forces and of what constraints keep at 0; rows and columns of comparable size.
Eigen::MatrixXd slopes(const LinearMotions& motions, const ExactValues& values) {
  std::vector<Expression> rows = motions.forces;
  rows.insert(rows.end(), motions.surface.begin(), motions.surface.end());
  Eigen::MatrixXd a(index(rows.size()), index(motions.x.size()));
  for (std::size_t i = 0; i < rows.size(); ++i) {
    for (std::size_t k = 0; k < motions.x.size(); ++k)
      a(index(i), index(k)) = values.value(differentiate(rows[i], motions.x[k])).value;
  }
  for (Eigen::Index i = 0; i < a.rows(); ++i) {
    if (const double size = a.row(i).cwiseAbs().maxCoeff(); size > 0) a.row(i) /= size;
  }
  for (Eigen::Index k = 0; k < a.cols(); ++k) {
    if (const double size = a.col(k).cwiseAbs().maxCoeff(); size > 0) a.col(k) /= size;
  }
  return a;
}

}  // namespace

std::vector<bool> decided_coordinates(const LinearMotions& motions, const ExactValues& values) {
  constexpr double rounding = 1e-8;  // the place is known by a double
  const std::size_t n = motions.x.size();
  if (n == 1 && motions.surface.empty())
    return {
        std::ranges::any_of(motions.forces, [&](const Expression& g) { return depends_on(g, motions.x); })};
  const Eigen::MatrixXd all = slopes(motions, values);
  std::vector<bool> decided(n);
  if (!all.allFinite()) return decided;
  const Eigen::Index of_all = rank(all, rounding);
  for (std::size_t k = 0; k < n; ++k) {
    Eigen::MatrixXd others = all;
    others.col(index(k)).setZero();
    decided[k] = rank(others, rounding) < of_all;
  }
  return decided;
}

}  // namespace qdot
