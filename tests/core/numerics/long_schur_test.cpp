// Against matrices whose eigenvalues are known, and against A Q = Q T.
#include "core/numerics/long_schur.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace qdot {
namespace {

constexpr long double near = 1e-17L;

LongMatrix cyclic_shift(Eigen::Index n) {
  LongMatrix a = LongMatrix::Zero(n, n);
  for (Eigen::Index i = 0; i < n; ++i) a(i, (i + 1) % n) = 1;
  return a;
}

LongMatrix of_sines(Eigen::Index n) {
  LongMatrix a(n, n);
  for (Eigen::Index i = 0; i < n; ++i) {
    for (Eigen::Index j = 0; j < n; ++j) a(i, j) = std::sin(static_cast<double>(1 + 3 * i + 7 * j * j));
  }
  return a;
}

TEST(LongSchur, IsAnUpperTriangleInAUnitaryBasis) {
  for (const Eigen::Index n : {1, 2, 3, 6, 9}) {
    const LongMatrix a = of_sines(n);
    const auto [t, q] = schur_form(a).value();
    EXPECT_LT((a.cast<LongComplex>() * q - q * t).cwiseAbs().maxCoeff(), n * near) << n;
    EXPECT_TRUE((q.adjoint() * q).isIdentity(n * near)) << n;
    for (Eigen::Index i = 0; i < n; ++i)
      EXPECT_TRUE((t.col(i).tail(n - 1 - i).array() == LongComplex(0)).all());
  }
}

TEST(LongSchur, FindsRootsOfUnityThatPlainShiftsDoNotSeparate) {
  const auto found = eigenvalues(cyclic_shift(4));
  ASSERT_EQ(found.size(), 4);
  for (const LongComplex& root : {LongComplex(1), LongComplex(-1), LongComplex(0, 1), LongComplex(0, -1)}) {
    EXPECT_LT((found.array() - root).abs().minCoeff(), near) << root;
  }
}

TEST(LongSchur, EigenvectorsAreKeptAndConjugateOnesExactly) {
  const LongMatrix a = of_sines(6);
  const auto [values, r] = eigenvectors(a);
  EXPECT_LT((a.cast<LongComplex>() * r - r * values.asDiagonal()).cwiseAbs().maxCoeff(), 1e-16L);
  for (Eigen::Index k = 0; k + 1 < 6; ++k) {
    if (values[k].imag() <= 0) continue;
    EXPECT_EQ(values[k + 1], std::conj(values[k]));
    EXPECT_EQ(r.col(k + 1), r.col(k).conjugate());
  }
}

TEST(LongSchur, HasNoNumbersWhereAnEntryIsNotFinite) {
  for (const long double entry : {std::nanl(""), HUGE_VALL}) {
    for (const Eigen::Index n : {1, 3}) {
      LongMatrix a = of_sines(n);
      a(n / 2, n / 2) = entry;
      EXPECT_FALSE(schur_form(a));
      EXPECT_TRUE(eigenvalues(a).array().isNaN().all());
    }
  }
}

}  // namespace
}  // namespace qdot
