#include "core/numerics/eigenvalue_clusters.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

#include "core/numerics/constants.hpp"
#include "core/numerics/long_schur.hpp"

namespace qdot {
namespace {

using Complex = LongComplex;
using Matrix = SquareMatrix<ComplexBall>;

std::size_t at(Eigen::Index i) { return static_cast<std::size_t>(i); }

Matrix product(const Matrix& a, const Matrix& b) {
  Matrix result(a.size());
  for (std::size_t i = 0; i < a.size(); ++i) {
    for (std::size_t j = 0; j < a.size(); ++j) {
      for (std::size_t k = 0; k < a.size(); ++k) result(i, j) = result(i, j) + a(i, k) * b(k, j);
    }
  }
  return result;
}

/// The eigenvalues number k and k + 1 of the diagonal change places.
void swap(LongSchur& schur, Eigen::Index k) {
  LongComplexMatrix& t = schur.t;
  const Complex above = t(k, k + 1);
  const Complex gap = t(k + 1, k + 1) - t(k, k);
  const long double length = std::hypot(std::abs(above), std::abs(gap));
  if (!(length > 0)) return;
  // The eigenvector of the second in the plane of both becomes the first direction.
  schur.turn(k, above / length, gap / length);
  t(k + 1, k) = 0;
}

/// How near eigenvalues are that hang together: a share of their size, or a length. Zeros that lack an
/// eigenvector have no size of their own.
struct Nearness {
  long double share{}, length{};
};

/// Which cluster each eigenvalue belongs to.
std::vector<std::size_t> clusters_of(const std::vector<Complex>& values, const Nearness& near) {
  std::vector<std::size_t> cluster(values.size());
  std::iota(cluster.begin(), cluster.end(), std::size_t{0});
  for (std::size_t i = 0; i < values.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      const long double size = std::max(std::abs(values[i]), std::abs(values[j]));
      const long double most = std::max(near.share * size, near.length);
      if (!(std::abs(values[i] - values[j]) <= most) || cluster[i] == cluster[j]) continue;
      std::ranges::replace(cluster, std::max(cluster[i], cluster[j]), std::min(cluster[i], cluster[j]));
    }
  }
  return cluster;
}

/// A basis in which the clusters are blocks of an upper triangular form, beside each other.
struct Basis {
  LongComplexMatrix x;
  std::vector<std::size_t> cluster;  ///< of each column
};

Basis basis_of(LongSchur schur, const Nearness& near) {
  const Eigen::Index n = schur.t.rows();
  std::vector<Complex> values;
  for (Eigen::Index i = 0; i < n; ++i) values.push_back(schur.t(i, i));
  std::vector<std::size_t> cluster = clusters_of(values, near);
  for (bool sorted = false; !sorted;) {  // by neighbours that change places
    sorted = true;
    for (Eigen::Index k = 0; k + 1 < n; ++k) {
      if (cluster[at(k)] <= cluster[at(k + 1)]) continue;
      swap(schur, k);
      std::swap(cluster[at(k)], cluster[at(k + 1)]);
      sorted = false;
    }
  }
  // X = Q R with R unit upper triangular and T R = R (T without what links clusters), column by column.
  LongComplexMatrix r = LongComplexMatrix::Identity(n, n);
  for (Eigen::Index j = 0; j < n; ++j) {
    for (Eigen::Index i = j - 1; i >= 0; --i) {
      if (cluster[at(i)] == cluster[at(j)]) continue;
      Complex sum = 0;
      for (Eigen::Index k = i + 1; k <= j; ++k) sum += schur.t(i, k) * r(k, j);
      for (Eigen::Index k = i; k < j; ++k) {
        if (k != i && cluster[at(k)] == cluster[at(j)]) sum -= r(i, k) * schur.t(k, j);
      }
      r(i, j) = sum / (schur.t(j, j) - schur.t(i, i));
    }
  }
  return {schur.q * r, cluster};
}

/// The pencil in a basis.
struct Seen {
  Matrix p{0}, q{0};
  std::vector<ComplexBall> values;
  std::vector<std::size_t> cluster;

  Seen(const Matrix& a, const Matrix& b, const Basis& basis) : cluster(basis.cluster) {
    const Matrix x = as_balls(basis.x);
    const Matrix bx = product(b, x);
    Matrix w = as_balls(inverse(middles(bx)));
    const Matrix rest = product(w, bx);
    Matrix correction(w.size());  // Newton's step for the inverse: 2 W - (W B X) W
    for (std::size_t i = 0; i < w.size(); ++i) {
      for (std::size_t j = 0; j < w.size(); ++j)
        correction(i, j) = middle_of((i == j ? ComplexBall(Ball(2)) : ComplexBall()) - rest(i, j));
    }
    w = product(correction, w);
    for (std::size_t i = 0; i < w.size(); ++i) {
      for (std::size_t j = 0; j < w.size(); ++j) w(i, j) = middle_of(w(i, j));
    }
    p = product(w, product(a, x));
    q = product(w, bx);
    for (std::size_t i = 0; i < w.size(); ++i) values.push_back(middle_of(p(i, i) / q(i, i)));
  }

  /// r_i for given weights.
  [[nodiscard]] double radius(std::size_t i, const std::vector<double>& weights) const {
    double sum = 0, moving = 0;
    for (std::size_t j = 0; j < values.size(); ++j) {
      const double share = weights[j] / weights[i];
      sum += magnitude(p(i, j) - values[i] * q(i, j)) * share;
      if (j != i) moving += magnitude(q(i, j)) * share;
    }
    const double pivot = 1 - magnitude(q(i, i) - ComplexBall(Ball(1))) - moving;
    return pivot > 0.5 ? sum / pivot * (1 + 0x1p-40) : infinity;
  }

  /// Falling along each cluster, so that its largest radius is the least.
  [[nodiscard]] std::vector<double> best_weights() const {
    std::vector<double> weights(values.size(), 1.0);
    for (std::size_t first = 0; first < values.size();) {
      std::size_t end = first;
      while (end < values.size() && cluster[end] == cluster[first]) ++end;
      if (end - first > 1) weigh(first, end, weights);
      first = end;
    }
    return weights;
  }

 private:
  void weigh(std::size_t first, std::size_t end, std::vector<double>& weights) const {
    double least = infinity;
    std::vector<double> best = weights;
    constexpr int finest = 100;
    for (int exponent = 0; exponent <= finest; ++exponent) {
      std::vector<double> trial = weights;
      for (std::size_t i = first; i < end; ++i)
        trial[i] = std::ldexp(1.0, -exponent * static_cast<int>(i - first));
      double largest = 0;
      for (std::size_t i = first; i < end; ++i) largest = std::max(largest, radius(i, trial));
      if (!(largest < least)) continue;
      least = largest;
      best = trial;
    }
    weights = best;
  }
};

double distance(const ComplexBall& a, const ComplexBall& b) { return magnitude(a - b); }

/// Discs that hang together, each set as one disc about its middle.
std::vector<EnclosedEigenvalue> joined(const Seen& seen) {
  const std::size_t n = seen.values.size();
  const std::vector<double> weights = seen.best_weights();
  std::vector<double> radii;
  for (std::size_t i = 0; i < n; ++i) radii.push_back(seen.radius(i, weights));
  std::vector<std::size_t> set(n);
  std::iota(set.begin(), set.end(), std::size_t{0});
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      const bool touch = !(distance(seen.values[i], seen.values[j]) * (1 - 0x1p-40) > radii[i] + radii[j]);
      if (touch && set[i] != set[j])
        std::ranges::replace(set, std::max(set[i], set[j]), std::min(set[i], set[j]));
    }
  }
  std::vector<EnclosedEigenvalue> result;
  for (std::size_t first = 0; first < n; ++first) {
    ComplexBall sum;
    std::size_t members = 0;
    for (std::size_t i = 0; i < n; ++i) {
      if (set[i] != first) continue;
      sum = sum + seen.values[i];
      ++members;
    }
    if (members == 0) continue;
    EnclosedEigenvalue one{middle_of(sum / ComplexBall(Ball(static_cast<double>(members)))), 0, members};
    for (std::size_t i = 0; i < n; ++i) {
      if (set[i] != first) continue;
      const double reach = (distance(seen.values[i], one.middle) + radii[i]) * (1 + 0x1p-40);
      one.radius = std::isfinite(reach) ? std::max(one.radius, reach) : infinity;
    }
    result.insert(result.end(), members, one);
  }
  return result;
}

/// How well eigenvalues are known, smaller is better.
double uncertainty(const std::vector<EnclosedEigenvalue>& found) {
  double sum = 0;
  for (const EnclosedEigenvalue& e : found) {
    const double share = e.radius / (magnitude(e.middle) + 1e-300);
    int exponent = 0;
    std::frexp(share, &exponent);
    sum += std::isfinite(share) ? std::max(-70, exponent) : 1000;
  }
  return sum;
}

}  // namespace

std::vector<EnclosedEigenvalue> enclose_eigenvalues(const Matrix& a, const Matrix& b) {
  const std::vector<EnclosedEigenvalue> nothing(a.size(), {{}, infinity, a.size()});
  const auto matrix = quotient(LongMatrix(middles(a).real()), LongMatrix(middles(b).real()));
  const auto schur = matrix ? schur_form(*matrix) : std::nullopt;
  if (!schur) return nothing;
  std::vector<EnclosedEigenvalue> best = nothing;
  const auto look = [&](const Nearness& near) {
    std::vector<EnclosedEigenvalue> found = joined(Seen(a, b, basis_of(*schur, near)));
    if (uncertainty(found) < uncertainty(best)) best = std::move(found);
  };
  for (const long double share : {0.0L, 1e-12L, 1e-9L, 1e-6L, 1e-4L, 1e-2L, 1e-1L}) look({.share = share});
  const long double largest = schur->t.diagonal().cwiseAbs().maxCoeff();
  for (const long double share : {1e-12L, 1e-9L, 1e-6L}) {
    if (!std::ranges::all_of(best, [](const auto& e) { return std::isfinite(e.radius); }))
      look({.length = share * largest});
  }
  return best;
}

}  // namespace qdot
