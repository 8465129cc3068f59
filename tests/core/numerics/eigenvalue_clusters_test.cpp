// Eigenvalues that are known by construction lie in their discs, eigenvectors or not.

#include "core/numerics/eigenvalue_clusters.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <complex>

#include "tests/support/random.hpp"

namespace qdot {
namespace {

using Matrix = SquareMatrix<ComplexBall>;
using Complex = std::complex<double>;

Matrix identity(std::size_t n) {
  Matrix result(n);
  for (std::size_t i = 0; i < n; ++i) result(i, i) = Ball(1);
  return result;
}

/// T X T^-1 for T = I + L with small whole numbers below the diagonal, all of it exact in doubles.
Matrix hidden(const std::vector<std::vector<double>>& x, test::Random& random) {
  const std::size_t n = x.size();
  std::vector<std::vector<double>> a = x;
  for (int k = 0; k < 6; ++k) {
    const std::size_t i = random.integer(0, static_cast<int>(n) - 1);
    const std::size_t j = (i + 1 + random.integer(0, static_cast<int>(n) - 2)) % n;
    const double c = random.integer(-2, 2);
    for (std::size_t m = 0; m < n; ++m) a[i][m] += c * a[j][m];
    for (std::size_t m = 0; m < n; ++m) a[m][j] -= c * a[m][i];
  }
  Matrix result(n);
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t j = 0; j < n; ++j) result(i, j) = Ball(a[i][j]);
  }
  return result;
}

/// Each disc holds as many of the exact values as it says.
void expect_held(const std::vector<EnclosedEigenvalue>& found, const std::vector<Complex>& exact) {
  ASSERT_EQ(found.size(), exact.size());
  for (const EnclosedEigenvalue& disc : found) {
    const Complex middle(disc.middle.re.value(), disc.middle.im.value());
    const auto inside = std::ranges::count_if(
        exact, [&](const Complex& e) { return std::abs(e - middle) <= disc.radius + 1e-16 * std::abs(e); });
    EXPECT_EQ(static_cast<std::size_t>(inside), disc.members) << middle << " " << disc.radius;
  }
}

TEST(EigenvalueClusters, OfHiddenJordanBlocksHoldAllMembers) {
  test::Random random(1);
  for (int k = 0; k < 200; ++k) {
    const std::size_t n = static_cast<std::size_t>(random.integer(2, 5));
    const auto size = static_cast<std::size_t>(random.integer(2, static_cast<int>(n)));
    std::vector<std::vector<double>> jordan(n, std::vector<double>(n));
    std::vector<Complex> exact;
    for (std::size_t i = 0; i < n; ++i) {
      jordan[i][i] = i < size ? -1 : static_cast<double>(i);
      if (i + 1 < size) jordan[i][i + 1] = 1;
      exact.emplace_back(jordan[i][i], 0.0);
    }
    const std::vector<EnclosedEigenvalue> found = enclose_eigenvalues(hidden(jordan, random), identity(n));
    expect_held(found, exact);
    for (const EnclosedEigenvalue& disc : found) EXPECT_LT(disc.radius, size < 4 ? 1e-4 : 3e-2);
  }
}

TEST(EigenvalueClusters, OfNearlyEqualEigenvaluesAreOneDiscOrSeparateOnes) {
  test::Random random(2);
  for (int k = 0; k < 200; ++k) {
    const double gap = std::ldexp(1.0, -random.integer(4, 50));
    const std::vector<std::vector<double>> triangle{{1, 1, 0}, {0, 1 + gap, 1}, {0, 0, 3}};
    Matrix a(3);
    for (std::size_t i = 0; i < 3; ++i) {
      for (std::size_t j = 0; j < 3; ++j) a(i, j) = Ball(triangle[i][j]);
    }
    expect_held(enclose_eigenvalues(a, identity(3)), {1.0, 1 + gap, 3.0});
  }
}

TEST(EigenvalueClusters, OfARotationAreItsAngle) {
  Matrix a(2);
  a(0, 1) = Ball(-1);
  a(1, 0) = Ball(1);
  expect_held(enclose_eigenvalues(a, identity(2)), {Complex(0, 1), Complex(0, -1)});
}

TEST(EigenvalueClusters, OfASingularPencilAreNotClaimed) {
  Matrix b(2);
  b(0, 0) = Ball(1);
  const auto found = enclose_eigenvalues(identity(2), b);
  ASSERT_EQ(found.size(), 2);
  for (const EnclosedEigenvalue& e : found) EXPECT_FALSE(std::isfinite(e.radius));
}

}  // namespace
}  // namespace qdot
