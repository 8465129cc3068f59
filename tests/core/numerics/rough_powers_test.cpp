// What is done without the C library's calls has its bits.

#include "core/numerics/rough_powers.hpp"

#include <gtest/gtest.h>

#include <limits>

#include "core/numerics/random_bits.hpp"

namespace qdot {
namespace {

void expect_same_parts(double x) {
  int own{}, of_library{};
  EXPECT_EQ(mantissa_of(x, own), std::frexp(x, &of_library)) << x;
  EXPECT_EQ(own, of_library) << x;
}

TEST(RoughPowers, TakeNumbersApartAsTheLibraryDoes) {
  using Limits = std::numeric_limits<double>;
  for (const double x : {Limits::denorm_min(), Limits::min() / 3, Limits::min(), 0.5, 1.0, Limits::max()})
    expect_same_parts(x);
  RandomBits random(3);
  for (int i = 0; i < 1000; ++i) expect_same_parts(std::ldexp(0.5 + random.fraction(), i - 500));
}

TEST(RoughPowers, ScaleByTwoAsTheLibraryDoes) {
  for (int k = -1100; k <= 1100; ++k) EXPECT_EQ(scaled_by_two(1.3, k), std::ldexp(1.3, k)) << k;
}

TEST(RoughPowers, AreInverseToFiveDigits) {
  for (const double x : {1e-300, 3e-9, 0.7, 1.0, 12.5, 4e200})
    EXPECT_NEAR(rough_exp2(rough_log2(x)), x, 1e-3 * x);
}

}  // namespace
}  // namespace qdot
