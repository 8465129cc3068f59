// Numbers of 31 digits as text: the nearest of so many digits, whatever they are.

#include "api/answers/simulate/extended_number.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "core/expr/number.hpp"
#include "tests/support/random.hpp"

namespace qdot::api {
namespace {

Number number_in(const std::string& text) {
  const bool negative = text.starts_with('-');
  const Number size = Number::written(text.substr(negative ? 1 : 0)).value();
  return negative ? -size : size;
}

TEST(ExtendedText, WritesWhatADecimalStandsFor) {
  const auto typed = [](const char* text) { return number_in(text).rounded().double_double(); };
  EXPECT_EQ(extended_text(typed("0.1")), "0.1");
  EXPECT_EQ(extended_text(typed("-1234.5678")), "-1234.5678");
  EXPECT_EQ(extended_text(typed("3e-7")), "3.0e-7");
  EXPECT_EQ(extended_text(typed("6.02e23")), "6.02e23");
  EXPECT_EQ(extended_text(0.0), "0.0");
  EXPECT_EQ(extended_text(1e20), "100000000000000000000.0");
  EXPECT_EQ(extended_text(1e21), "1.0e21");
  EXPECT_EQ(extended_text(0.1, 20), "0.10000000000000000555");
}

TEST(ExtendedText, RoundsToTheNearestAndTiesToTheEvenDigit) {
  EXPECT_EQ(extended_text(0.125, 2), "0.12");
  EXPECT_EQ(extended_text(0.375, 2), "0.38");
  EXPECT_EQ(extended_text({0.125, 1e-25}, 2), "0.13");
  EXPECT_EQ(extended_text(999.75, 3), "1000.0");
  EXPECT_EQ(extended_text({1.0, -1e-25}, 20), "1.0");
  EXPECT_EQ(extended_text({1.0, -1e-25}, 31), "0.9999999999999999999999999");
}

TEST(ExtendedText, IsWithinHalfAUnitOfItsLastDigit) {
  test::Random random(11);
  for (int i = 0; i < 2000; ++i) {
    const double high = random.real(-1, 1) * std::ldexp(1.0, static_cast<int>(random.integer(-200, 200)));
    const DoubleDouble x = fast_two_sum(high, high * random.real(-0x1p-53, 0x1p-53));
    const int digits = static_cast<int>(random.integer(1, 31));
    const Number exact = Number::real(x.high) + Number::real(x.low);
    const Number off = (number_in(extended_text(x, digits)) - exact) / exact;
    EXPECT_LE(std::abs(off.value()), 0.5 * std::pow(10.0, 1 - digits) * (1 + 1e-12)) << high << " " << digits;
  }
}

}  // namespace
}  // namespace qdot::api
