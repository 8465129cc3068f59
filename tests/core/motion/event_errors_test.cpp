// The error of an event's time where the error of the states around it is known.

#include "core/motion/event_errors.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/support/motions.hpp"

namespace qdot {
namespace {

constexpr double speed = 2, off = 1e-9;

/// For an event of a mass that is at x = 0.7 at t = 0.3, `off` at most from there, and moves at 2 m/s under
/// this force.
std::optional<double> error_of(const std::string& event, double velocity = speed,
                               const std::string& force = "0*F", double t = 0.3, double x_error = off,
                               double x = 0.7) {
  const auto model = test::mass_under(force);
  const Dynamics dynamics(model);
  SimulationRequest request = test::request_for(*model, {}, {0, 1});
  request.events = {event};
  const std::vector<double> scale{1.4, speed}, errors{x_error, 0};
  EventErrors found(dynamics, request, scale);
  const auto error = found.of(EventRecord{event, t, {x, velocity}}, errors, scale);
  return error ? std::optional(error->time) : std::nullopt;
}

TEST(EventErrors, AreThoseOfTheStateByItsSpeedWhateverTheSlopeOfTheEvent) {
  for (const std::string event :
       {"x = 0.7*L", "(x - 0.7*L)^3 = 0", "(x - 0.7*L)^5 = 0",
        "(x - 0.7*L)^3*(1e-16*L^2 + (x - 0.7*L)^2) = 0", "(x - 0.7*L)/(L^2 + 1e18*(x - 0.7*L)^2) = 0"}) {
    const auto error = error_of(event);
    ASSERT_TRUE(error) << event;
    EXPECT_GE(*error, off / speed) << event;
    EXPECT_LE(*error, 2 * off / speed) << event;
  }
}

/// Written out they are small differences of large numbers, and rounded to zero near their roots: doubles
/// find any place within the roots of their rounding, and twice the digits tell how far it is from the root.
TEST(EventErrors, CountTheWidthOfMultipleRootsThatAreWrittenOut) {
  const std::string cube = "x^3 - 2.1*L*x^2 + 1.47*L^2*x - 0.343*L^3 = 0";
  const std::string fifth = "x^5 - 3.5*L*x^4 + 4.9*L^2*x^3 - 3.43*L^3*x^2 + 1.2005*L^4*x - 0.16807*L^5 = 0";
  for (const auto& [event, width] :
       {std::pair(cube, std::cbrt(0x1p-53)), std::pair(fifth, std::pow(0x1p-53, 0.2))}) {
    for (const double beside : {0.0, 0.1 * width, -0.9 * width}) {
      const auto error =
          error_of(event, speed, "-3*F*x/L", 0.3, 0, 0.7 + beside);  // x = 0.7 + 2 tau - 3 tau^2/2
      ASSERT_TRUE(error) << event;
      EXPECT_GE(*error * speed, 0.99 * std::abs(beside)) << event;
      EXPECT_LE(*error * speed, 20 * width) << event;
    }
  }
}

TEST(EventErrors, GrowWhereTheEventIsNearlyTouched) {
  const auto error = error_of("x = 0.7*L", 1e-4, "-2*F");  // 1e-4 tau - tau^2 = 1e-9
  ASSERT_TRUE(error);
  EXPECT_GE(*error, 1.1270e-5);
  EXPECT_LE(*error, 2.5e-5);
}

TEST(EventErrors, AreNotToldWhereItMayNotHappen) {
  EXPECT_FALSE(error_of("x = 0.7*L", 1e-5, "-2*F"));
  EXPECT_FALSE(error_of("(x - 0.7*L)^2 = 0"));
}

TEST(EventErrors, EndAtTheStartOfTheTimeToo) {
  ASSERT_TRUE(error_of("x = 0.7*L", speed, "0*F", 0, 0));
  EXPECT_LE(*error_of("x = 0.7*L", speed, "0*F", 0, 0), 1e-14);
  EXPECT_FALSE(error_of("x = 0.7*L", 0, "0*F", 0, 0));
}

}  // namespace
}  // namespace qdot
