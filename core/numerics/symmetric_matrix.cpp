#include "core/numerics/symmetric_matrix.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <vector>

namespace qdot {
namespace {

using Index = Eigen::Index;

/// Once all entries are small, a sweep squares them.
constexpr int most_sweeps = 60;

/// Columns p and q times (c, s; -s, c).
void rotate_columns(LongMatrix& a, Index p, Index q, long double c, long double s) {
  for (Index i = 0; i < a.rows(); ++i) {
    const long double x = a(i, p), y = a(i, q);
    a(i, p) = c * x - s * y;
    a(i, q) = s * x + c * y;
  }
}

void rotate_rows(LongMatrix& a, Index p, Index q, long double c, long double s) {
  for (Index j = 0; j < a.cols(); ++j) {
    const long double x = a(p, j), y = a(q, j);
    a(p, j) = c * x - s * y;
    a(q, j) = s * x + c * y;
  }
}

bool is_lost_beside(long double small, long double large) {
  return std::abs(large) + std::abs(small) == std::abs(large);
}

/// Turns A's entry (p, q) to zero; false if it was as good as zero.
bool rotate(LongMatrix& a, LongMatrix& vectors, Index p, Index q) {
  const long double beside = a(p, q);
  a(p, q) = a(q, p) = 0;
  if (is_lost_beside(beside, a(p, p)) && is_lost_beside(beside, a(q, q))) return false;
  const long double half = (a(q, q) - a(p, p)) / (2 * beside);
  const long double t = (half >= 0 ? 1 : -1) / (std::abs(half) + std::sqrt(half * half + 1));
  const long double c = 1 / std::sqrt(t * t + 1), s = t * c;
  const long double first = a(p, p) - t * beside, second = a(q, q) + t * beside;
  rotate_columns(a, p, q, c, s);
  rotate_rows(a, p, q, c, s);
  rotate_columns(vectors, p, q, c, s);
  a(p, p) = first;
  a(q, q) = second;
  a(p, q) = a(q, p) = 0;
  return true;
}

LongAxes in_ascending_order(const LongMatrix& diagonal, const LongMatrix& vectors) {
  std::vector<Index> order(static_cast<std::size_t>(diagonal.rows()));
  std::iota(order.begin(), order.end(), Index{0});
  std::ranges::stable_sort(order, [&](Index i, Index j) { return diagonal(i, i) < diagonal(j, j); });
  LongAxes result{LongVector(diagonal.rows()), vectors};
  for (Index i = 0; i < diagonal.rows(); ++i) {
    const Index from = order[static_cast<std::size_t>(i)];
    result.values[i] = diagonal(from, from);
    result.vectors.col(i) = vectors.col(from);
  }
  return result;
}

/// L with L L^T = M, lower triangular; no value where M is not positive definite.
std::optional<LongMatrix> cholesky_factor(const LongMatrix& m) {
  LongMatrix l = LongMatrix::Zero(m.rows(), m.cols());
  for (Index j = 0; j < m.cols(); ++j) {
    for (Index i = j; i < m.rows(); ++i) {
      long double rest = m(i, j);
      for (Index k = 0; k < j; ++k) rest -= l(i, k) * l(j, k);
      if (i == j && !(rest > 0)) return std::nullopt;
      l(i, j) = i == j ? std::sqrt(rest) : rest / l(j, j);
    }
  }
  return l;
}

/// L^-1 B.
LongMatrix solved_forward(const LongMatrix& l, LongMatrix b) {
  for (Index j = 0; j < b.cols(); ++j) {
    for (Index i = 0; i < b.rows(); ++i) {
      for (Index k = 0; k < i; ++k) b(i, j) -= l(i, k) * b(k, j);
      b(i, j) /= l(i, i);
    }
  }
  return b;
}

/// L^-T B.
LongMatrix solved_backward(const LongMatrix& l, LongMatrix b) {
  for (Index j = 0; j < b.cols(); ++j) {
    for (Index i = b.rows() - 1; i >= 0; --i) {
      for (Index k = i + 1; k < b.rows(); ++k) b(i, j) -= l(k, i) * b(k, j);
      b(i, j) /= l(i, i);
    }
  }
  return b;
}

}  // namespace

LongAxes symmetric_axes(LongMatrix a) {
  for (Index j = 0; j < a.cols(); ++j) {
    for (Index i = 0; i < j; ++i) a(i, j) = a(j, i);
  }
  LongMatrix vectors = LongMatrix::Identity(a.rows(), a.cols());
  bool turned = true;
  for (int sweep = 0; turned && sweep < most_sweeps; ++sweep) {
    turned = false;
    for (Index p = 0; p < a.rows(); ++p) {
      for (Index q = p + 1; q < a.rows(); ++q) turned = rotate(a, vectors, p, q) || turned;
    }
  }
  return in_ascending_order(a, vectors);
}

/// With M = L L^T, (L^-1 K L^-T) u = w u for u = L^T v.
std::optional<LongAxes> principal_axes(const LongMatrix& k, const LongMatrix& m) {
  const auto l = cholesky_factor(m);
  if (!l) return std::nullopt;
  LongMatrix symmetric = k;
  for (Index j = 0; j < k.cols(); ++j) {
    for (Index i = 0; i < j; ++i) symmetric(i, j) = k(j, i);
  }
  LongAxes axes = symmetric_axes(solved_forward(*l, solved_forward(*l, symmetric).transpose()));
  if (!axes.values.allFinite()) return std::nullopt;
  axes.vectors = solved_backward(*l, axes.vectors);
  return axes;
}

}  // namespace qdot
