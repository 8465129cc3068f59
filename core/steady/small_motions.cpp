#include "core/steady/small_motions.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/base/error.hpp"
#include "core/numerics/long_schur.hpp"
#include "core/numerics/same_bits.hpp"
#include "core/numerics/symmetric_matrix.hpp"

namespace qdot {
namespace {

using Vectors = std::vector<std::vector<ComplexBall>>;

Eigen::Index row_of(std::size_t i) { return static_cast<Eigen::Index>(i); }

bool is_symmetric(const SquareMatrix<Ball>& a, int sign) {
  for (std::size_t i = 0; i < a.size(); ++i) {
    for (std::size_t j = 0; j <= i; ++j) {
      if (!(sign > 0 ? a(i, j) - a(j, i) : a(i, j) + a(j, i)).contains_zero()) return false;
    }
  }
  return true;
}

/// M^-1 K.
LongMatrix divided_by_mass(const LongMatrix& k, const LongMatrix& m) {
  if (auto result = quotient(k, m)) return *std::move(result);
  throw Error(
      ErrorCode::not_applicable,
      "The mass matrix has no inverse at the equilibrium: some motion of the coordinates moves no mass "
      "there.");
}

/// Of symmetric matrices, in units that make the masses ones; no columns where M is not positive definite.
LongMatrix symmetric_vectors(const LongMatrix& k, const LongMatrix& m) {
  const LongVector scale = m.diagonal().cwiseSqrt().cwiseInverse();
  LongMatrix scaled_stiffness = k, scaled_mass = m;
  for (Eigen::Index i = 0; i < m.rows(); ++i) {
    for (Eigen::Index j = 0; j < m.cols(); ++j) {
      scaled_stiffness(i, j) = scale[i] * k(i, j) * scale[j];
      scaled_mass(i, j) = scale[i] * m(i, j) * scale[j];
    }
  }
  const auto axes = principal_axes(scaled_stiffness, scaled_mass);
  return axes ? LongMatrix(scale.asDiagonal() * axes->vectors) : LongMatrix();
}

Eigensystem<Ball> none() { return {{}, {}, SquareMatrix<Ball>(0), {}, {}}; }

ComplexBall conjugate_root(const ComplexBall& a) { return {a.re, -a.im}; }

/// m s^2 + d s + k = 0: s = (-d +- sqrt(d^2 - 4 m k))/(2 m), also where both are one.
Eigensystem<ComplexBall> quadratic_roots(const Ball& m, const Ball& d, const Ball& k) {
  const Ball discriminant = square(d) - Ball(4) * m * k;
  Eigensystem<ComplexBall> result{{}, {}, SquareMatrix<ComplexBall>(2), std::vector<double>(4, 0.0), {0, 1}};
  std::vector<ComplexBall> roots(2, -d / (Ball(2) * m));
  if (discriminant.contains_zero()) {
    roots[0].re.radius += std::sqrt(discriminant.magnitude()) / std::abs(m.middle.high);
    roots[1] = roots[0];
    result.group = {0, 0};
  } else if (discriminant.middle.high < 0) {
    roots[0].im = sqrt(-discriminant) / (Ball(2) * m);
    roots[1] = conjugate_root(roots[0]);
  } else {  // the larger root first, the other without cancellation
    const Ball root = sqrt(discriminant);
    const Ball sum = d.middle.high > 0 ? -d - root : root - d;
    roots[0] = sum / (Ball(2) * m);
    roots[1] = Ball(2) * k / sum;
  }
  for (std::size_t i = 0; i < 2; ++i) {
    result.values.push_back(middle_of(roots[i]));
    result.radii.push_back(hypotenuse(roots[i].re.radius, roots[i].im.radius) * (1 + 0x1p-50));
    result.vectors(0, i) = Ball(1);
    result.vectors(1, i) = result.values[i];
  }
  return result;
}

/// One coordinate, in a unit of mass and one of time that make its numbers about ones: of other sizes the
/// discriminant may have no place among doubles.
Eigensystem<ComplexBall> one_coordinate(const Ball& mass, const Ball& rate, const Ball& stiffness) {
  const int unit = size_of(mass);
  const Ball d = scaled(rate, -unit), k = scaled(stiffness, -unit);
  const int swings = size_of(k) / 2;
  const int frequency = d.is_zero() ? swings : k.is_zero() ? size_of(d) : std::max(size_of(d), swings);
  Eigensystem<ComplexBall> result =
      quadratic_roots(scaled(mass, -unit), scaled(d, -frequency), scaled(k, -2 * frequency));
  for (std::size_t i = 0; i < 2; ++i) {
    const ComplexBall s = result.values[i];
    result.values[i] = {scaled(s.re, frequency), scaled(s.im, frequency)};
    result.radii[i] = std::ldexp(result.radii[i], frequency);
    result.vectors(1, i) = result.values[i];
  }
  return result;
}

bool contains_zero(const ComplexBall& a) { return a.re.contains_zero() && a.im.contains_zero(); }

void subtract(std::vector<ComplexBall>& a, const ComplexBall& factor, const std::vector<ComplexBall>& b) {
  for (std::size_t i = 0; i < a.size(); ++i) a[i] = a[i] - factor * b[i];
}

}  // namespace

bool SmallMotions::depends_on_squares() const {
  for (std::size_t i = 0; i < size(); ++i) {
    for (std::size_t j = 0; j < size(); ++j) {
      if (!rates(i, j).is_zero()) return false;
    }
  }
  return true;
}

bool SmallMotions::undamped() const {
  return is_symmetric(mass, 1) && is_symmetric(stiffness, 1) && is_symmetric(rates, -1);
}

Eigensystem<Ball> squares(const SmallMotions& motions) {
  const LongMatrix k = middles(motions.stiffness), m = middles(motions.mass);
  LongMatrix columns;
  if (is_symmetric(motions.mass, 1) && is_symmetric(motions.stiffness, 1) && m.diagonal().minCoeff() > 0)
    columns = symmetric_vectors(k, m);
  if (columns.size() == 0) {
    const LongEigenvectors found = eigenvectors(divided_by_mass(k, m));
    if ((found.values.imag().array() != 0).any()) return none();
    columns = found.columns.real();
  }
  return enclose_eigensystem(motions.stiffness, motions.mass, as_balls(columns));
}

StatePencil state_pencil(const SmallMotions& motions) {
  const std::size_t n = motions.size();
  StatePencil pencil{SquareMatrix<ComplexBall>(2 * n), SquareMatrix<ComplexBall>(2 * n)};
  auto& [a, b] = pencil;
  for (std::size_t i = 0; i < n; ++i) {
    a(i, n + i) = b(i, i) = Ball(1);
    for (std::size_t j = 0; j < n; ++j) {
      a(n + i, j) = -motions.stiffness(i, j);
      a(n + i, n + j) = -motions.rates(i, j);
      b(n + i, n + j) = motions.mass(i, j);
    }
  }
  return pencil;
}

Eigensystem<ComplexBall> exponents(const SmallMotions& motions) {
  const std::size_t n = motions.size();
  const LongMatrix m = middles(motions.mass);
  LongMatrix state = LongMatrix::Zero(row_of(2 * n), row_of(2 * n));
  state.topRightCorner(row_of(n), row_of(n)).setIdentity();
  state.bottomLeftCorner(row_of(n), row_of(n)) = -divided_by_mass(middles(motions.stiffness), m);
  state.bottomRightCorner(row_of(n), row_of(n)) = -divided_by_mass(middles(motions.rates), m);
  if (n == 1) return one_coordinate(motions.mass(0, 0), motions.rates(0, 0), motions.stiffness(0, 0));
  const auto [a, b] = state_pencil(motions);
  return enclose_eigensystem(a, b, as_balls(eigenvectors(state).columns));
}

Vectors echelon_form(Vectors vectors) {
  const std::size_t rows = vectors.empty() ? 0 : vectors[0].size();
  std::size_t done = 0;
  for (std::size_t row = 0; row < rows && done < vectors.size(); ++row) {
    const auto pivot =
        std::max_element(vectors.begin() + static_cast<std::ptrdiff_t>(done), vectors.end(),
                         [&](const auto& a, const auto& b) { return magnitude(a[row]) < magnitude(b[row]); });
    if (contains_zero((*pivot)[row])) continue;
    std::swap(*pivot, vectors[done]);
    const ComplexBall first = vectors[done][row];
    for (ComplexBall& entry : vectors[done]) entry = entry / first;
    vectors[done][row] = Ball(1);
    for (std::size_t i = 0; i < vectors.size(); ++i) {
      if (i == done) continue;
      const ComplexBall factor = vectors[i][row];
      subtract(vectors[i], factor, vectors[done]);
      vectors[i][row] = Ball(0);
    }
    ++done;
  }
  for (auto& vector : vectors) {
    for (ComplexBall& entry : vector) {
      for (Ball* part : {&entry.re, &entry.im}) {
        if (part->contains_zero()) *part = Ball(DoubleDouble{}, part->magnitude());
      }
    }
  }
  return vectors;
}

Vectors kernel(const SquareMatrix<Ball>& k) {
  SquareMatrix<ComplexBall> entries(k.size());
  for (std::size_t i = 0; i < k.size(); ++i) {
    for (std::size_t j = 0; j < k.size(); ++j) entries(i, j) = k(i, j);
  }
  return kernel(entries);
}

Vectors kernel(const SquareMatrix<ComplexBall>& k) {
  const std::size_t n = k.size();
  Vectors rows(n, std::vector<ComplexBall>(n));
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t j = 0; j < n; ++j) rows[i][j] = k(i, j);
  }
  rows = echelon_form(rows);
  std::vector<std::size_t> pivots;
  for (const auto& row : rows) {
    for (std::size_t j = 0; j < n; ++j) {
      if (contains_zero(row[j])) continue;
      pivots.push_back(j);
      break;
    }
  }
  Vectors basis;
  for (std::size_t j = 0; j < n; ++j) {
    if (std::find(pivots.begin(), pivots.end(), j) != pivots.end()) continue;
    basis.emplace_back(n);
    basis.back()[j] = Ball(1);
    for (std::size_t i = 0; i < pivots.size(); ++i) basis.back()[pivots[i]] = ComplexBall() - rows[i][j];
  }
  return echelon_form(basis);
}

}  // namespace qdot
