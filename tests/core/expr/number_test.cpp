// Numbers are exact rationals; the second road is 113-bit arithmetic, and GMP's own for what is rounded.

#include "core/expr/number.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "core/base/error.hpp"
#include "core/numerics/ball.hpp"
#include "core/numerics/interval.hpp"
#include "tests/support/random.hpp"

namespace qdot {
namespace {

Number written(std::string_view text) { return Number::written(text).value(); }

TEST(Number, IsAnExactRational) {
  EXPECT_EQ(Number::ratio(1, 3) + Number::ratio(1, 6), Number::ratio(1, 2));
  EXPECT_EQ(Number::ratio(2, 3) * Number::ratio(9, 4), Number::ratio(3, 2));
  EXPECT_EQ(Number::ratio(6, -4), Number::ratio(-3, 2));
  EXPECT_EQ(Number(7) / Number(21), Number::ratio(1, 3));
  EXPECT_EQ(power(Number::ratio(2, 3), -3), Number::ratio(27, 8));
  EXPECT_EQ(gcd(Number::ratio(3, 4), Number::ratio(9, 10)), Number::ratio(3, 20));
  EXPECT_TRUE((Number::ratio(1, 3) - Number::ratio(1, 3)).is_zero());
  EXPECT_EQ(Number::real(3), Number(3));
}

TEST(Number, StaysExactBeyondTheRangeOfIntegersThatAreDoubles) {
  const std::int64_t most = std::int64_t{1} << 53;
  const Number large = Number(most) * Number(3) + Number(1);
  EXPECT_NE(large, Number(most) * Number(3));
  EXPECT_EQ(large - Number(1), Number(3) * Number(most));
  EXPECT_EQ(large / large, Number(1));
  EXPECT_TRUE(large.is_integer());
  EXPECT_FALSE(large.small());
  const Number fine = Number::ratio(1, most) * Number::ratio(1, 3);
  EXPECT_EQ(Number(3) * fine * Number(most), Number(1));
  EXPECT_LT(fine, Number::ratio(1, most));
  EXPECT_EQ(power(written("1e-200"), 3) * power(written("1e200"), 3), Number(1));
}

TEST(Number, OfTheLeastIntegerIsInLowestTerms) {
  constexpr std::int64_t least = std::numeric_limits<std::int64_t>::min();
  EXPECT_EQ(Number::ratio(least, 6), Number::ratio(least / 2, 3));
  EXPECT_EQ(Number::ratio(least, least), Number(1));
  EXPECT_EQ(Number(least) + Number(least), Number(2) * Number(least));
}

TEST(Number, ADifferenceOfDecimalsIsWhatItIsOnPaper) {
  // In doubles 4e-22 and the 1e-12 are lost.
  const Number a = written("100.1") * written("100.1") * written("100.1");
  EXPECT_EQ(a - written("1003003.001"), Number(0));
  EXPECT_EQ(written("1e-12") + a - a, written("1e-12"));
  EXPECT_EQ(written("42949672963") / Number(10), Number::ratio(42949672963, 10));
}

TEST(Number, HoldsTheRootsAndDivisorsOfLargeNumbers) {
  const Number a = power(written("123456789.123456789"), 4);
  EXPECT_EQ(exact_root(a), power(written("123456789.123456789"), 2));
  EXPECT_EQ(exact_root(a + Number(1)), std::nullopt);
  EXPECT_EQ(exact_root(Number(-4)), std::nullopt);
  EXPECT_EQ(exact_root(Number::ratio(9, 4)), Number::ratio(3, 2));
  EXPECT_EQ(gcd(a * Number(6), a * Number(15)), a * Number(3));
}

TEST(Number, IsWrittenAsADecimalWhereItHasFinitelyManyDigits) {
  EXPECT_EQ(written("0.0500").decimal()->digits, "5");
  EXPECT_EQ(written("0.0500").decimal()->exponent, -2);
  EXPECT_EQ(written("6.02e23").decimal()->exponent, 21);
  EXPECT_EQ(Number::ratio(-3, 8).decimal()->digits, "375");
  EXPECT_FALSE(Number::ratio(1, 3).decimal());
  for (const char* text : {"", ".", "1e", "e3", "1.2.3", "-1", "+1", " 1", "0x1", "1e400", "1e-400", "inf"}) {
    EXPECT_FALSE(Number::written(text)) << text;
  }
}

TEST(Number, RefusesDigitsWithoutEnd) {
  Number number = written("1.000000000000000000001");
  EXPECT_THROW(for (;;) number = number * number, Error);
}

TEST(Number, PowersOverflowToInfinityAndNotToNonsense) {
  EXPECT_EQ(power(Number(10), 22).value(), 1e22);
  EXPECT_EQ(power(Number(1'000'000), 64).value(), std::numeric_limits<double>::infinity());
  EXPECT_EQ(power(Number(1'000'000), -64).value(), 0);
  EXPECT_EQ(power(Number(1'000'000), 64) * power(Number(1'000'000), -64), Number(1));
}

/// Of all sizes, with and without finitely many digits.
Number some_number(test::Random& random) {
  const int exponent = static_cast<int>(random.integer(-330, 310));
  const Number digits(random.integer(1, 9'000'000'000'000'000));
  const Number size = power(Number(10), exponent) * power(Number(10), -15);
  const Number sign(random.integer(0, 1) == 0 ? 1 : -1);
  return random.integer(0, 2) == 0 ? sign * digits * size / Number(random.integer(1, 1000))
                                   : sign * digits * size;
}

bool between(double lower, const Number& x, double upper) {
  return !(std::isfinite(lower) && x < Number::real(lower)) &&
         !(std::isfinite(upper) && Number::real(upper) < x);
}

TEST(Number, IsRoundedToTheNearestDoubleWithWhatItLeavesOut) {
  test::Random random(5);
  for (int i = 0; i < 20'000; ++i) {
    const Number x = some_number(random);
    const Real real = x.rounded();
    ASSERT_EQ(real.value, x.value());
    if (!std::isfinite(real.value)) continue;
    const Number left = x - Number::real(real.value);
    const double gap = std::nextafter(std::abs(real.value), INFINITY) - std::abs(real.value);
    const Number size = left.is_negative() ? -left : left;
    ASSERT_FALSE(Number::real(gap / 2) < size && gap / 2 > 0) << real.value;
    ASSERT_EQ(real.low, left.value());
    const Number rest = left - Number::real(real.low);
    ASSERT_EQ(rest.is_zero(), real.error == 0);
    ASSERT_TRUE(between(-real.error, rest, real.error)) << real.value;
    ASSERT_LE(real.error, 0x1.1p-106 * std::abs(real.value) + 5e-324) << real.value;
  }
}

TEST(Number, RoundsAsTheMachineReadsDecimals) {
  test::Random random(6);
  for (int i = 0; i < 20'000; ++i) {
    std::string text = std::to_string(random.integer(0, 9)) + ".";
    for (auto digits = random.integer(1, 30); digits > 0; --digits) {
      text += static_cast<char>('0' + random.integer(0, 9));
    }
    text += "1e" + std::to_string(random.integer(-323, 307));
    const auto number = Number::written(text);
    ASSERT_EQ(number ? number->value() : 0, std::strtod(text.c_str(), nullptr)) << text;
  }
}

TEST(Number, IsRoundedToTheEvenDoubleHalfwayBetweenTwo) {
  const std::int64_t most = std::int64_t{1} << 53;
  EXPECT_EQ((Number(most) + Number(1)).value(), 0x1p53);
  EXPECT_EQ((Number(most) + Number(3)).value(), 0x1p53 + 4);
  EXPECT_EQ((Number(most) + Number(1) + written("1e-300")).value(), 0x1p53 + 2);
  const Number least = Number::real(5e-324);
  EXPECT_EQ((least / Number(2)).value(), 0);
  EXPECT_EQ((least * Number::ratio(3, 2)).value(), 1e-323);
  EXPECT_EQ((least * Number::ratio(5, 2)).value(), 1e-323);
  const Number greatest = Number::real(std::numeric_limits<double>::max());
  EXPECT_EQ((greatest + written("9.9e291")).value(), std::numeric_limits<double>::max());
  EXPECT_EQ((greatest + written("1e292")).value(), INFINITY);
}

TEST(Number, LiesInTheIntervalAndTheBallOfItsLiteral) {
  test::Random random(7);
  for (int i = 0; i < 20'000; ++i) {
    const Number x = some_number(random);
    const Interval interval = Interval::literal(x.rounded());
    ASSERT_TRUE(between(interval.lower, x, interval.upper)) << x.value();
    if (!std::isfinite(x.value())) continue;
    const bool tight =
        interval.upper == interval.lower || interval.upper == std::nextafter(interval.lower, INFINITY);
    ASSERT_TRUE(tight || std::abs(x.value()) < 1e-300) << x.value();
    const Ball ball = Ball::literal(x.rounded());
    const Number beside = x - Number::real(ball.middle.high) - Number::real(ball.middle.low);
    ASSERT_TRUE(between(-ball.radius, beside, ball.radius)) << x.value();
  }
}

}  // namespace
}  // namespace qdot
