// A ball that bounces, in double-doubles, against the parabolas between its impacts.

#include "core/motion/extended_impacts.hpp"

#include <gtest/gtest.h>

#include "core/numerics/double_double_function.hpp"
#include "tests/support/motions.hpp"

namespace qdot {
namespace {

constexpr double height = 1.25, gravity = 9.8125, restitution = 0.5;  // doubles
constexpr double of_double_doubles = 1e-28;                           ///< of the size of the values

Scene ball() {
  Scene s;
  s.name = "ball";
  s.parameters = {{"m", "kg", "1", {}, "", ""}};
  s.coordinates = {{"y", "m", "1.25", "0", "", {}, "", ""}};
  s.points = {{"P", {"0", "y"}}};
  s.bodies = {Particle{"body", "m", {"P", {}}}};
  s.gravity = {"0", "-9.8125"};
  s.events = {{"floor", "y", Crossing::falling, "", ""}};
  s.impact = Impact{"floor", {{"y_dot", "-0.5*y_dot"}}, ""};
  return s;
}

class BouncingBall : public testing::Test {
 protected:
  BouncingBall() {
    const auto model = build_model(ball());
    dynamics_ = std::make_unique<Dynamics>(model);
    SimulationRequest request = test::request_for(*model, {}, test::instants(1.2, 24));
    request.method = Method::taylor;
    request.tolerances = {1e-7, 1e-9};
    motion_ = simulate(*dynamics_, request);
    extended_ = extended_request(request.parameters, request.y_start, 0, request.grid);
  }

  /// y and y' at t.
  static std::pair<DoubleDouble, DoubleDouble> exact(double t) {
    const DoubleDouble first = sqrt(DoubleDouble(2 * height) / DoubleDouble(gravity));
    DoubleDouble last = -first, speed = DoubleDouble(gravity) * first;
    for (;;) {
      const DoubleDouble next = last + DoubleDouble(2) * speed / DoubleDouble(gravity);
      if (is_before(DoubleDouble(t), next)) break;
      last = next;
      speed = DoubleDouble(restitution) * speed;
    }
    const DoubleDouble s = DoubleDouble(t) - last;
    return {(speed - DoubleDouble(gravity / 2) * s) * s, speed - DoubleDouble(gravity) * s};
  }

  [[nodiscard]] std::optional<ExtendedRun> through() const {
    return extended_states_through(motion_.sections, *dynamics_, extended_);
  }

  std::unique_ptr<Dynamics> dynamics_;
  Simulation motion_;
  ExtendedMotionRequest extended_;
};

TEST_F(BouncingBall, HasTheDigitsOfDoubleDoublesAfterItsImpacts) {
  ASSERT_EQ(motion_.sections.size(), 2U);
  const auto run = through();
  ASSERT_TRUE(run);
  ASSERT_EQ(run->rows, extended_.grid.size());
  for (std::size_t i = 0; i < run->rows; ++i) {
    const auto [y, rate] = exact(extended_.grid[i].high);
    EXPECT_LT(std::abs((run->states[2 * i] - y).high), of_double_doubles) << i;
    EXPECT_LT(std::abs((run->states[2 * i + 1] - rate).high), 10 * of_double_doubles) << i;
  }
}

TEST_F(BouncingBall, IsNotFollowedThroughAnImpactThatIsElsewhere) {
  motion_.sections[0].t += 0.1;
  EXPECT_FALSE(through());
}

TEST_F(BouncingBall, IsNotFollowedWhereARowMayBelongToEitherSide) {
  const double t = motion_.sections[0].t;
  motion_.sections[0].t = t - 1e-5;
  const auto after =
      std::ranges::find_if(extended_.grid, [&](const DoubleDouble& row) { return row.high > t; });
  *after = t - 5e-6;
  EXPECT_FALSE(through());
}

}  // namespace
}  // namespace qdot
