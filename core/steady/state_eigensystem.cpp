#include "core/steady/state_eigensystem.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "core/numerics/eigenvalue_clusters.hpp"
#include "core/numerics/long_schur.hpp"
#include "core/steady/small_motions.hpp"

namespace qdot {
namespace {

using StateMatrix = SquareMatrix<ComplexBall>;

/// Columns near all eigenvectors, as far as they have directions of their own.
StateMatrix near_eigenvectors(const StateMatrix& a) {
  return as_balls(eigenvectors(middles(a).real()).columns);
}

/// Where some eigenvectors are nearly parallel: eigenvalues by clusters, eigenvectors from A - s.
Eigensystem<ComplexBall> by_clusters(const StateMatrix& a, const StateMatrix& unit) {
  const std::size_t size = a.size();
  const std::vector<EnclosedEigenvalue> found = enclose_eigenvalues(a, unit);
  Eigensystem<ComplexBall> result{{}, {}, StateMatrix(size), std::vector<double>(size * size, 0.0), {}};
  for (std::size_t i = 0; i < size; ++i) {
    result.values.push_back(found[i].middle);
    result.radii.push_back(found[i].radius);
  }
  for (std::size_t first = 0; first < size; first += found[first].members) {
    ComplexBall s = found[first].middle;
    s.re.radius = s.im.radius = found[first].radius;
    StateMatrix rest = a;
    for (std::size_t i = 0; i < size; ++i) rest(i, i) = rest(i, i) - s;
    const std::vector<std::vector<ComplexBall>> vectors = kernel(rest);
    for (std::size_t k = 0; k < found[first].members; ++k) {
      result.group.push_back(first);
      if (vectors.empty()) result.radii[first + k] = std::numeric_limits<double>::infinity();
      for (std::size_t i = 0; i < size && !vectors.empty(); ++i)
        result.vectors(i, first + k) = vectors[k % vectors.size()][i];
    }
  }
  return result;
}

}  // namespace

Eigensystem<ComplexBall> state_eigensystem(const SquareMatrix<ComplexBall>& a) {
  StateMatrix unit(a.size());
  for (std::size_t i = 0; i < a.size(); ++i) unit(i, i) = Ball(1);
  Eigensystem<ComplexBall> found = enclose_eigensystem(a, unit, near_eigenvectors(a));
  const bool enclosed = std::ranges::all_of(found.radii, [](double r) { return std::isfinite(r); });
  return enclosed ? found : by_clusters(a, unit);
}

}  // namespace qdot
