// The signs of random polynomials with known zeros, and of functions near them.

#include "core/numerics/sign_search.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/numerics/constants.hpp"
#include "tests/support/random.hpp"

namespace qdot {
namespace {

/// prod (u - zeros_i)
std::vector<double> with_zeros(const std::vector<double>& zeros) {
  std::vector<double> c{1};
  for (const double zero : zeros) {
    c.insert(c.begin(), 0);
    for (std::size_t k = 0; k + 1 < c.size(); ++k) c[k] -= zero * c[k + 1];
  }
  return c;
}

double value(const std::vector<double>& c, double u) {
  double sum = 0;
  for (std::size_t k = c.size(); k-- > 0;) sum = sum * u + c[k];
  return sum;
}

/// Changes between neighbouring definite signs.
std::size_t changes(const std::vector<SignPiece>& pieces) {
  std::size_t count = 0;
  int last = 0;
  for (const SignPiece& piece : pieces) {
    if (piece.sign == 0) continue;
    if (last == -piece.sign) ++count;
    last = piece.sign;
  }
  return count;
}

TEST(SignSearch, FindsEveryZeroOfPolynomialsWithKnownOnes) {
  test::Random random(3);
  for (int i = 0; i < 500; ++i) {
    std::vector<double> zeros;
    const int count = static_cast<int>(random.real(1, 7));
    while (zeros.size() < static_cast<std::size_t>(count)) {
      const double zero = random.real(0.01, 0.99);
      const auto is_near = [&](double other) { return std::abs(other - zero) < 1e-3; };
      if (std::none_of(zeros.begin(), zeros.end(), is_near)) zeros.push_back(zero);
    }
    std::vector<double> all = zeros;
    for (int k = 0; k < 3; ++k) all.push_back(random.real(1.2, 3));  // and some outside
    EXPECT_EQ(changes(signs_of(with_zeros(all), 1e-15)), zeros.size());
  }
}

TEST(SignSearch, EveryPieceHasTheSignItSays) {
  test::Random random(4);
  for (int i = 0; i < 300; ++i) {
    std::vector<double> c;
    for (int k = 0; k < 12; ++k) c.push_back(random.real(-1, 1));
    const double remainder = std::pow(10.0, random.real(-12, -1));
    double from = 0;
    for (const SignPiece& piece : signs_of(c, remainder)) {
      EXPECT_GE(piece.from, from);
      from = piece.to;
      for (int k = 0; k <= 20; ++k) {
        const double g = value(c, piece.from + (piece.to - piece.from) * k / 20);
        EXPECT_TRUE(piece.sign == 0 || piece.sign * g > remainder * (1 - 1e-6) - 1e-14);
      }
    }
  }
}

TEST(SignSearch, TouchingZeroIsADoubtAndNoChange) {
  const std::vector<SignPiece> pieces = signs_of(with_zeros({0.3, 0.3}), 1e-12);
  EXPECT_EQ(changes(pieces), 0U);
  ASSERT_EQ(pieces.size(), 3U);
  EXPECT_EQ(pieces[1].sign, 0);
  EXPECT_NEAR(pieces[1].from, 0.3, 2e-5);
  EXPECT_NEAR(pieces[1].to, 0.3, 2e-5);
}

TEST(SignSearch, SaysNothingWithoutABound) {
  const std::vector<SignPiece> pieces = signs_of(std::vector<double>{1, 2}, infinity);
  ASSERT_EQ(pieces.size(), 1U);
  EXPECT_EQ(pieces[0].sign, 0);
}

}  // namespace
}  // namespace qdot
