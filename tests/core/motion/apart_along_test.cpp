// Two motions that are apart by e when one of them meets an event, against both followed by hand.

#include "core/motion/apart_along.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace qdot {
namespace {

constexpr double g = 9.81;

/// A ball that falls on the floor at x = 0, from which it comes back with a part of its speed.
struct Ball {
  double restitution{0.7}, speed{3};

  [[nodiscard]] SectionEnd end() const {
    return {.t = 2,
            .before = {0, -speed},
            .slopes_before = {-speed, -g},
            .after = {0, restitution * speed},
            .slopes_after = {restitution * speed, -g},
            .reached = {1, speed},
            .g = [](double, std::span<const double> y) { return y[0]; },
            .map =
                [r = restitution](double, const std::vector<double>& y) {
                  return std::vector{y[0], -r * y[1]};
                }};
  }

  /// Where a ball is `later` than another one met the floor, from where it was then.
  [[nodiscard]] std::vector<double> after(double x, double v, double later) const {
    const double falls = (v + std::sqrt(v * v + 2 * g * x)) / g;  // x + v s - g s^2/2 = 0
    const double up = restitution * (g * falls - v), flight = later - falls;
    return {up * flight - g * flight * flight / 2, up - g * flight};
  }
};

TEST(ApartAfter, AnImpactIsAsTwoBallsAre) {
  const Ball ball;
  for (const auto& [ex, ev] : {std::pair{1e-6, 0.0}, {0.0, 1e-6}, {-2e-6, 1e-6}}) {
    const std::vector<double> e = apart_after(ball.end(), std::vector{ex, ev});
    constexpr double later = 0.1;
    const std::vector<double> one = ball.after(0, -ball.speed, later),
                              other = ball.after(-ex, -ball.speed - ev, later);
    EXPECT_NEAR(e[0] + later * e[1], one[0] - other[0], 1e-10);
    EXPECT_NEAR(e[1], one[1] - other[1], 1e-10);
  }
}

TEST(ApartAfter, AnImpactIsTheSameForDistancesBelowALastPlace) {
  const Ball ball;
  const std::vector<double> large = apart_after(ball.end(), std::vector{1e-6, 3e-6}),
                            small = apart_after(ball.end(), std::vector{1e-25, 3e-25});
  for (std::size_t i = 0; i < 2; ++i) EXPECT_NEAR(small[i] * 1e19, large[i], 1e-4 * std::abs(large[i]));
}

/// A plate that rises with the acceleration a, at 0 and at rest when the first of two balls meets it.
TEST(ApartAfter, AnImpactOnAPlateThatGainsSpeedIsAsTwoBallsAre) {
  constexpr double a = 40, e = 0.8, speed = 3, ey = 1e-7, ev = -2e-7, later = 0.1;
  const auto plate = [](double tau) { return a * tau * tau / 2; };
  const auto map = [](double tau, const std::vector<double>& y) {
    return std::vector{y[0], (1 + e) * a * tau - e * y[1]};
  };
  const SectionEnd end{.t = 0,
                       .before = {0, -speed},
                       .slopes_before = {-speed, -g},
                       .after = {0, e * speed},
                       .slopes_after = {e * speed, -g},
                       .reached = {1, speed},
                       .g = [&](double t, std::span<const double> y) { return y[0] - plate(t); },
                       .map = map};
  const auto after = [&](double y, double v) {  // y + v s - (g + a) s^2/2 = 0
    const double b = g + a, falls = (v + std::sqrt(v * v + 2 * b * y)) / b, flight = later - falls;
    const double up = map(falls, {0, v - g * falls})[1];
    return std::vector{plate(falls) + up * flight - g * flight * flight / 2, up - g * flight};
  };
  const std::vector<double> one = after(0, -speed), other = after(-ey, -speed - ev),
                            found = apart_after(end, std::vector{ey, ev});
  EXPECT_NEAR(found[0] + later * found[1], one[0] - other[0], 1e-11);
  EXPECT_NEAR(found[1], one[1] - other[1], 1e-11);
  EXPECT_NEAR(rates_of_instant(end)[1], (1 + e) * (a + g), 1e-3);
}

/// One ball goes on through the floor for a while, and is then sent back.
TEST(RatesOfInstant, AreThoseOfABallThatIsSentBackTooLate) {
  const Ball ball;
  const std::vector<double> rates = rates_of_instant(ball.end());
  EXPECT_NEAR(rates[0], -ball.speed - ball.restitution * ball.speed, 1e-6);
  EXPECT_NEAR(rates[1], ball.restitution * g + g, 1e-6);
}

/// x'' = -1 up to x = 1, and 4 beyond it.
TEST(ApartAfter, AKinkHasTheSlopesOfBothSides) {
  const SectionEnd end{.t = 0,
                       .before = {1, 2},
                       .slopes_before = {2, -1},
                       .after = {1, 2},
                       .slopes_after = {2, 4},
                       .reached = {1, 2},
                       .g = [](double, std::span<const double> y) { return y[0] - 1; }};
  const std::vector<double> e = apart_after(end, std::vector{1e-8, 0.0});
  EXPECT_NEAR(e[0], 1e-8, 1e-13);
  EXPECT_NEAR(e[1], 5 * 1e-8 / 2, 1e-13);  // the other one meets the kink 1e-8/2 later
}

TEST(ApartAfter, WhereAMotionGrazesItIsAsLargeAsTheMotion) {
  SectionEnd end = Ball{}.end();
  end.slopes_before = {0, -g};
  EXPECT_EQ(apart_after(end, std::vector{1e-6, 1e-3}), (std::vector{1.0, 3.0}));
}

}  // namespace
}  // namespace qdot
