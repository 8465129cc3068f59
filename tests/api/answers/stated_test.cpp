// What an answer states as an error covers all that the reader of its digits does not see.

#include "api/answers/stated.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

namespace qdot::api {
namespace {

TEST(StatedNumber, HasWhatItsDigitsRoundAwayInItsError) {
  EXPECT_GE(stated_error({0.96223, 0}, 3).get<double>(), 0.00023);
  EXPECT_LE(stated_error({0.96223, 0}, 3).get<double>(), 0.000231);
  EXPECT_GE(stated_error({0.96223, 1e-5}, 3).get<double>(), 0.00024);
  EXPECT_EQ(stated_error({0.5, 0}, 3).get<double>(), 0);
  EXPECT_EQ(stated_error({0.5, 1.234e-9}, 2).get<double>(), 1.3e-9);
}

TEST(StatedNumber, IsWithinItsErrorAsADecimalAndAsADouble) {
  const double third = 1.0 / 3;  // written as 0.3333333333333333; the double is 0.333333333333333314829616256
  EXPECT_GE(stated_error({third, 0}, shortest_digits).get<double>(), 1.48296e-17);
  EXPECT_LE(stated_error({third, 0}, shortest_digits).get<double>(), 1.5e-17);
  EXPECT_EQ(stated_error({0.75, 0}, shortest_digits).get<double>(), 0);
  // written as 52028976569112550.0, as no other double is nearer to that
  EXPECT_GE(stated_error({52028976569112552.0, 0}, shortest_digits).get<double>(), 2);
  EXPECT_LE(stated_error({52028976569112552.0, 0}, shortest_digits).get<double>(), 2.1);
}

TEST(StatedNumber, OfWhichNothingIsKnownHasNoError) {
  EXPECT_TRUE(stated_error({1, std::numeric_limits<double>::infinity()}, 3).is_null());
  EXPECT_TRUE(stated_error({1, std::numeric_limits<double>::quiet_NaN()}, shortest_digits).is_null());
}

TEST(StatedNumber, ThatWasConvertedHasTheConversionsRoundingInItsError) {
  const Stated angle{1, 0};
  const Interval degrees = angle.enclosure() * Interval(180) / enclosed_pi();
  const Stated found = Stated::within(180 / std::numbers::pi, degrees);
  const long double expected = 180 / std::numbers::pi_v<long double>;
  EXPECT_LE(std::abs(found.value - expected), found.error);
  EXPECT_LT(found.error, 1e-13);
}

TEST(StatedNumber, ThatNothingDecidesIsOffByWhatTheDoubleLeavesOut) {
  const Real half_pi{exact_pi.value / 2, exact_pi.low / 2, exact_pi.error / 2};
  EXPECT_GE((Stated{half_pi.value, 0}.as_typed(half_pi).error), half_pi.low);
  EXPECT_EQ((Stated{half_pi.value, 1e-20}.as_typed(half_pi).error), 1e-20);
  EXPECT_EQ((Stated{0.5, 0}.as_typed(half_pi).error), 0);
}

TEST(StatedNumber, OfTheComplexPlaneCountsBothParts) {
  const double error = stated_error(std::complex<double>(1.04, 2.03), 0, 2).get<double>();
  EXPECT_GE(error, 0.05 - 1e-12);
  EXPECT_LE(error, 0.051);
}

}  // namespace
}  // namespace qdot::api
