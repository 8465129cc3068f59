#include "core/numerics/eigensystem.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/numerics/constants.hpp"
#include "core/numerics/long_matrix.hpp"

namespace qdot {
namespace {

constexpr int most_refinements = 4;
/// What a correction as small as this leaves is its square.
constexpr double converged = 0x1p-50;

template <class T>
SquareMatrix<T> operator*(const SquareMatrix<T>& a, const SquareMatrix<T>& b) {
  const std::size_t n = a.size();
  SquareMatrix<T> product(n);
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t j = 0; j < n; ++j) {
      for (std::size_t k = 0; k < n; ++k) product(i, j) = product(i, j) + a(i, k) * b(k, j);
    }
  }
  return product;
}

template <class T>
SquareMatrix<T> middle_of(SquareMatrix<T> a) {
  for (std::size_t i = 0; i < a.size(); ++i) {
    for (std::size_t j = 0; j < a.size(); ++j) a(i, j) = middle_of(a(i, j));
  }
  return a;
}

/// W and the pencil seen from the eigenvectors, P = W A X, Q = W B X.
template <class T>
struct Diagonal {
  SquareMatrix<T> p, q;
  std::vector<T> values;      ///< P_ii/Q_ii, middles
  std::vector<double> noise;  ///< their radii

  Diagonal(const SquareMatrix<T>& a, const SquareMatrix<T>& b, const SquareMatrix<T>& x) : p(0), q(0) {
    const SquareMatrix<T> bx = b * x;
    SquareMatrix<T> w = as_balls(inverse(middles(bx)));
    SquareMatrix<T> rest = w * bx;  // Newton's step for the inverse: W + (I - W B X) W
    for (std::size_t i = 0; i < x.size(); ++i) rest(i, i) = rest(i, i) - T(Ball(2));
    w = middle_of(rest * w);
    for (std::size_t i = 0; i < x.size(); ++i) {
      for (std::size_t j = 0; j < x.size(); ++j) w(i, j) = T() - w(i, j);
    }
    p = w * (a * x);
    q = w * bx;
    for (std::size_t i = 0; i < x.size(); ++i) {
      const T quotient = p(i, i) / q(i, i);
      values.push_back(middle_of(quotient));
      noise.push_back(magnitude(quotient - values.back()));
    }
  }

  [[nodiscard]] double rest(std::size_t i, std::size_t j, const T& value) const {
    return magnitude(p(i, j) - value * q(i, j));
  }
  [[nodiscard]] double gap(std::size_t i, std::size_t j) const { return magnitude(values[i] - values[j]); }
  [[nodiscard]] bool separated(std::size_t i, std::size_t j) const {
    const double size = std::max(magnitude(values[i]), magnitude(values[j]));
    return gap(i, j) > inseparable * size + 16 * (noise[i] + noise[j]);
  }
};

/// X (I + E); returns the largest |E_ij|.
template <class T>
double improve(SquareMatrix<T>& x, const Diagonal<T>& now) {
  const std::size_t n = x.size();
  SquareMatrix<T> step(n);
  double largest = 0;
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t j = 0; j < n; ++j) {
      if (i == j || !now.separated(i, j)) continue;
      const T rest = now.p(i, j) - now.values[j] * now.q(i, j);
      step(i, j) = middle_of(rest / (now.values[j] - now.values[i]));
      largest = std::max(largest, magnitude(step(i, j)));
    }
  }
  const SquareMatrix<T> change = x * step;
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t j = 0; j < n; ++j) x(i, j) = middle_of(x(i, j) + change(i, j));
  }
  return largest;
}

/// r_i of Gershgorin's theorem. Rows other than those of the group are scaled by `weight` < 1 so far that
/// they stay dominant over the whole disc, which makes the radius second order in what is off the diagonal.
template <class T>
double radius(const Diagonal<T>& d, const std::vector<std::size_t>& group, std::size_t i) {
  const std::size_t n = group.size();
  const T& value = d.values[i];
  double weight = 0;
  double coupling = 0;  // from one column of Q, what moves with lambda
  for (std::size_t j = 0; j < n; ++j) {
    if (group[j] == group[i]) continue;
    double row = 0;
    for (std::size_t k = 0; k < n; ++k) {
      if (k != j) row += d.rest(j, k, value) + d.gap(i, j) * magnitude(d.q(j, k));
    }
    weight = std::max(weight, 8 * row / d.gap(i, j));
  }
  if (!(weight < 1)) return infinity;
  double sum = d.rest(i, i, value);
  for (std::size_t j = 0; j < n; ++j) {
    if (j == i) continue;
    const double share = group[j] == group[i] ? 1 : weight;
    sum += share * d.rest(i, j, value);
    coupling += share * magnitude(d.q(i, j));
  }
  const double pivot = 1 - magnitude(d.q(i, i) - T(Ball(1))) - coupling;
  return pivot > 0.5 ? sum / pivot * (1 + 0x1p-40) : infinity;
}

template <class T>
std::vector<std::size_t> groups_of(const Diagonal<T>& d) {
  std::vector<std::size_t> group(d.values.size());
  for (std::size_t i = 0; i < group.size(); ++i) {
    group[i] = i;
    for (std::size_t j = 0; j < i; ++j) {
      if (d.separated(i, j) || group[i] == group[j]) continue;
      const std::size_t merged = group[i];
      std::replace(group.begin(), group.begin() + static_cast<std::ptrdiff_t>(i) + 1, merged, group[j]);
    }
  }
  return group;
}

/// From the discs of single eigenvalues, in which each group of k has k, to bounds of each member: any of
/// them may lie anywhere in the group's discs. Nothing is proven where the discs of two groups meet.
template <class T>
std::vector<double> radii_of_members(const Diagonal<T>& d, const std::vector<std::size_t>& group,
                                     const std::vector<double>& discs) {
  std::vector<double> radii = discs;
  for (std::size_t i = 0; i < group.size(); ++i) {
    for (std::size_t j = 0; j < group.size(); ++j) {
      if (j == i) continue;
      const double gap = d.gap(i, j);
      if (group[j] == group[i]) {
        radii[i] = std::max(radii[i], (gap + discs[j]) * (1 + 0x1p-40));
      } else if (!(discs[i] < gap / 4) || !(discs[j] < gap / 4)) {
        radii[i] = infinity;
      }
    }
  }
  for (std::size_t i = 0; i < group.size(); ++i) {  // what is not proven of one is not of its group
    for (std::size_t j = 0; j < group.size(); ++j) {
      if (group[j] == group[i] && !std::isfinite(radii[j])) radii[i] = infinity;
    }
  }
  return radii;
}

template <class T>
Eigensystem<T> enclosed(const SquareMatrix<T>& a, const SquareMatrix<T>& b, SquareMatrix<T> x) {
  const std::size_t n = a.size();
  Diagonal<T> d(a, b, x);
  for (int i = 0; i < most_refinements; ++i) {
    const double step = improve(x, d);
    d = Diagonal<T>(a, b, x);
    if (!(step > converged)) break;
  }
  Eigensystem<T> result{d.values, {}, x, std::vector<double>(n * n, 0.0), groups_of(d)};
  std::vector<double> discs;
  for (std::size_t i = 0; i < n; ++i) discs.push_back(radius(d, result.group, i));
  result.radii = radii_of_members(d, result.group, discs);
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t j = 0; j < n; ++j) {
      if (result.group[j] == result.group[i]) continue;
      // Twice the first order of what is left of E covers the rest of the series.
      const double e = 2 * d.rest(j, i, d.values[i]) / d.gap(i, j);
      for (std::size_t k = 0; k < n; ++k) result.bounds[k * n + i] += e * magnitude(x(k, j));
    }
  }
  return result;
}

}  // namespace

Eigensystem<Ball> enclose_eigensystem(const SquareMatrix<Ball>& a, const SquareMatrix<Ball>& b,
                                      SquareMatrix<Ball> vectors) {
  return enclosed(a, b, std::move(vectors));
}

Eigensystem<ComplexBall> enclose_eigensystem(const SquareMatrix<ComplexBall>& a,
                                             const SquareMatrix<ComplexBall>& b,
                                             SquareMatrix<ComplexBall> vectors) {
  return enclosed(a, b, std::move(vectors));
}

}  // namespace qdot
