// Small linear systems against Eigen, well conditioned, badly scaled and nearly singular.

#include "core/numerics/linear_system.hpp"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>
#include <optional>
#include <vector>

#include "tests/support/random.hpp"

namespace qdot {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

/// Solutions of M x = b, one a column; no value where M is called singular.
std::optional<MatrixXd> solved(const MatrixXd& m, const MatrixXd& b) {
  const auto n = static_cast<std::size_t>(m.rows());
  std::vector<double> rows, columns;
  for (Eigen::Index i = 0; i < m.rows(); ++i) {
    for (Eigen::Index j = 0; j < m.cols(); ++j) rows.push_back(m(i, j));
  }
  for (Eigen::Index k = 0; k < b.cols(); ++k) {
    for (Eigen::Index i = 0; i < b.rows(); ++i) columns.push_back(b(i, k));
  }
  if (!solve_linear(n, rows, columns)) return std::nullopt;
  return Eigen::Map<MatrixXd>(columns.data(), b.rows(), b.cols());
}

MatrixXd random_matrix(test::Random& random, Eigen::Index rows, Eigen::Index columns) {
  MatrixXd m(rows, columns);
  for (Eigen::Index i = 0; i < m.size(); ++i) m.data()[i] = random.real(-1, 1);
  return m;
}

/// |x - y| where both solve the same system: round-off times the condition number, with room for growth.
double tolerance(const MatrixXd& m, const MatrixXd& x) {
  const auto values = m.jacobiSvd().singularValues();
  return 1e-14 * values(0) / values(values.size() - 1) * (1 + x.norm());
}

TEST(LinearSystem, IsSolvedAsEigenDoes) {
  test::Random random(10);
  for (int i = 0; i < 1000; ++i) {
    const Eigen::Index n = 1 + i % 16;
    const MatrixXd m = random_matrix(random, n, n), b = random_matrix(random, n, 3);
    const MatrixXd expected = m.fullPivLu().solve(b);
    const auto found = solved(m, b);
    ASSERT_TRUE(found.has_value()) << m;
    EXPECT_LE((*found - expected).norm(), tolerance(m, expected)) << m;
  }
}

TEST(LinearSystem, IsSolvedWhateverTheUnitsOfItsRows) {
  test::Random random(11);
  for (int i = 0; i < 200; ++i) {
    const MatrixXd m = random_matrix(random, 4, 4), b = random_matrix(random, 4, 1);
    VectorXd units(4);
    for (double& unit : units) unit = std::pow(10.0, static_cast<double>(random.integer(-12, 12)));
    const auto plain = solved(m, b);
    const auto scaled = solved(units.asDiagonal() * m, units.asDiagonal() * b);
    ASSERT_TRUE(plain && scaled);
    EXPECT_LE((*plain - *scaled).norm(), tolerance(m, *plain));
  }
}

TEST(LinearSystem, NeedsItsRowsExchanged) {
  MatrixXd m(2, 2);
  m << 0, 1, 1, 0;
  MatrixXd b(2, 1);
  b << 2, 3;
  const auto x = solved(m, b);
  ASSERT_TRUE(x.has_value());
  EXPECT_EQ((*x)(0), 3);
  EXPECT_EQ((*x)(1), 2);
}

TEST(LinearSystem, ChoosesPivotsByTheScaleOfTheirRows) {
  MatrixXd m(2, 2);
  m << 10, 1e18, 1, 1;
  MatrixXd b(2, 1);
  b << 1e18, 2;
  const auto x = solved(m, b);
  ASSERT_TRUE(x.has_value());
  EXPECT_DOUBLE_EQ((*x)(0), 1);  // 0 if the larger 10 were taken
  EXPECT_DOUBLE_EQ((*x)(1), 1);
}

TEST(LinearSystem, IsCalledSingularWhereItsLastDigitsAreLost) {
  test::Random random(12);
  int called = 0;
  constexpr int tried = 1000;
  for (int i = 0; i < tried; ++i) {
    const Eigen::Index n = 2 + i % 3;
    MatrixXd m = random_matrix(random, n, n);
    m.row(n - 1) = m.topRows(n - 1).colwise().sum();  // to round-off
    const bool singular = !solved(m, random_matrix(random, n, 1)).has_value();
    EXPECT_TRUE(singular || n > 2) << m;
    called += singular ? 1 : 0;
  }
  EXPECT_GE(called, tried * 97 / 100);  // pivots that have shrunk on the way hide one in a hundred
  EXPECT_FALSE(solved(MatrixXd::Zero(3, 3), MatrixXd::Ones(3, 1)).has_value());
}

/// [M A^T; A 0], two constraints of four coordinates whose masses have the unit `mass`; A b = b where `b` is
/// that of other constraints, and none where there is none.
MatrixXd with_constraints(test::Random& random, double mass, bool dependent) {
  const MatrixXd root = random_matrix(random, 4, 4);
  MatrixXd slopes = random_matrix(random, 2, 4);
  if (dependent) slopes.row(1) = random.real(0.3, 3) * slopes.row(0);  // to round-off
  MatrixXd m = MatrixXd::Zero(6, 6);
  m.topLeftCorner(4, 4) = mass * (root * root.transpose() + MatrixXd::Identity(4, 4));
  m.bottomLeftCorner(2, 4) = slopes;
  m.topRightCorner(4, 2) = slopes.transpose();
  return m;
}

TEST(LinearSystem, OfConstraintsIsSolvedWhateverTheUnitOfMass) {
  for (const double mass : {1e-100, 1.67e-27, 1e-14, 1.0, 1e16, 2e30, 1e100}) {
    test::Random random(15);
    for (int i = 0; i < 100; ++i) {
      const MatrixXd m = with_constraints(random, mass, false);
      VectorXd x = random_matrix(random, 6, 1);
      x.tail(2) *= mass;  // forces
      const auto found = solved(m, m * x);
      ASSERT_TRUE(found.has_value()) << mass << '\n' << m;
      EXPECT_LE((found->topRows(4) - x.head(4)).norm(), 1e-10) << mass << '\n' << m;
      EXPECT_LE((found->bottomRows(2) - x.tail(2)).norm(), 1e-10 * mass) << mass << '\n' << m;
    }
  }
}

TEST(LinearSystem, OfConstraintsThatDependOnEachOtherIsSingularWhateverTheUnitOfMass) {
  for (const double mass : {1e-100, 1.67e-27, 1e-14, 1.0, 1e16, 2e30, 1e100}) {
    test::Random random(16);
    int called = 0;
    constexpr int tried = 200;
    for (int i = 0; i < tried; ++i) {
      const MatrixXd m = with_constraints(random, mass, true);
      called += solved(m, random_matrix(random, 6, 1)).has_value() ? 0 : 1;
    }
    EXPECT_EQ(called, tried) << mass;
  }
}

TEST(LinearSystem, IsSolvedWhileSomeDigitsAreLeft) {
  test::Random random(13);
  for (const double gap : {1e-4, 1e-8, 1e-12}) {
    for (int i = 0; i < 100; ++i) {
      MatrixXd m = random_matrix(random, 3, 3);
      m.row(2) = m.row(0) + m.row(1) + gap * m.row(2);
      const VectorXd x = random_matrix(random, 3, 1);
      const auto found = solved(m, m * x);
      ASSERT_TRUE(found.has_value()) << gap;
      EXPECT_LE((*found - x).norm(), tolerance(m, x)) << gap;
    }
  }
}

TEST(LinearSystem, WithAnEntryThatIsNoNumberIsNotSolved) {
  MatrixXd m = MatrixXd::Identity(2, 2);
  m(0, 1) = std::nan("");
  const auto x = solved(m, MatrixXd::Ones(2, 1));
  EXPECT_TRUE(!x.has_value() || x->hasNaN());
}

std::vector<double> by_rows(const MatrixXd& m) {
  std::vector<double> result;
  for (Eigen::Index i = 0; i < m.rows(); ++i) {
    for (Eigen::Index j = 0; j < m.cols(); ++j) result.push_back(m(i, j));
  }
  return result;
}

TEST(LinearSystem, ABoundHoldsForEveryMatrixOfItsFamily) {
  test::Random random(14);
  int finite = 0;
  for (int i = 0; i < 300; ++i) {
    const MatrixXd middle = random_matrix(random, 3, 3) + 2 * MatrixXd::Identity(3, 3);
    const MatrixXd moving = random.real(0, 0.6) * random_matrix(random, 3, 3);
    const MatrixXd radius = random.real(0, 0.1) * random_matrix(random, 3, 3).cwiseAbs();
    const VectorXd rho = random_matrix(random, 3, 1).cwiseAbs();
    VectorXd bound(3);
    const std::vector<double> m = by_rows(middle), a = by_rows(moving), r = by_rows(radius);
    bound_solution(3, {m, r, a}, {rho.data(), 3}, {bound.data(), 3});
    if (!std::isfinite(bound(0))) continue;
    ++finite;
    for (int k = 0; k < 50; ++k) {
      const MatrixXd one =
          middle + random.real(-1, 1) * moving + radius.cwiseProduct(random_matrix(random, 3, 3));
      const VectorXd x = one.fullPivLu().solve(rho.cwiseProduct(random_matrix(random, 3, 1)));
      for (Eigen::Index j = 0; j < 3; ++j) EXPECT_LE(std::abs(x(j)), bound(j));
    }
  }
  EXPECT_GT(finite, 150);
}

TEST(LinearSystem, WhatMovesTogetherIsTakenTogether) {
  const std::vector<double> middle{2, 1, 1, 1}, moving{1.6, 0.8, 0.8, 0.8}, none(4), rho{1, 1};
  std::vector<double> bound(2);
  bound_solution(2, {middle, none, moving}, rho, bound);  // (1 + 0.8 w) M
  EXPECT_LT(bound[1], 5 * 3 * 1.2);
  bound_solution(2, {middle, moving}, rho, bound);
  EXPECT_FALSE(std::isfinite(bound[1]));
}

}  // namespace
}  // namespace qdot
