// Motions that textbooks give in closed form.

#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <numbers>

#include "tests/support/motions.hpp"
#include "tests/support/states.hpp"

namespace qdot {
namespace {

using std::numbers::pi;
using test::instants;
using test::row;

/// The best method's error over a few periods, amplified by less than a hundred here.
constexpr double closed_form = 1e-10;

TEST(KeplersPlanet, ReturnsAfterItsPeriodOnItsEllipse) {
  const double e = 0.5, a = 1;  // perihelion a (1 - e) = 0.5, mu = 1
  const std::vector<double> grid = instants(2 * pi, 100);
  const Simulation motion = test::motion_of("kepler", {}, grid);
  ASSERT_EQ(motion.rows, grid.size());
  for (std::size_t i = 0; i < motion.rows; ++i) {
    const double r = row(motion, i)[0], theta = row(motion, i)[1];
    EXPECT_NEAR(r, a * (1 - e * e) / (1 + e * std::cos(theta)), closed_form);
  }
  EXPECT_NEAR(motion.y[0], a * (1 - e), closed_form);
  EXPECT_NEAR(motion.y[1], 2 * pi, closed_form);
}

TEST(AtwoodsMachine, FallsUniformlyAccelerated) {
  const Values given{{"m1", 0.5}, {"m2", 0.4}, {"x_dot", -1}};
  const std::vector<double> grid = instants(2, 10);
  const Simulation motion = test::motion_of("atwood", given, grid);
  for (std::size_t i = 0; i < motion.rows; ++i) {
    const double t = grid[i];
    EXPECT_NEAR(row(motion, i)[0], 0.3 - t + 9.81 / 9 * t * t / 2, closed_form);
  }
  EXPECT_EQ(motion.rows, grid.size());
}

TEST(DampedOscillator, DiesOutAtItsOwnFrequency) {
  const double beta = 0.3 / (2 * 0.5), omega = std::sqrt(8 / 0.5 - beta * beta);
  const std::vector<double> grid = instants(10, 50);
  const Simulation motion = test::motion_of("damped_oscillator", {}, grid);
  ASSERT_EQ(motion.rows, grid.size());
  for (std::size_t i = 0; i < motion.rows; ++i) {
    const double phase = omega * grid[i];
    const double x = 0.2 * std::exp(-beta * grid[i]) * (std::cos(phase) + beta / omega * std::sin(phase));
    EXPECT_NEAR(row(motion, i)[0], x, closed_form);
  }
  EXPECT_TRUE(motion.conserved.empty());
}

TEST(DampedOscillator, FollowsAForceOnItsResonanceCurve) {
  const double m = 0.5, b = 2, k = 8, w = 3, F = 1;
  const auto model = test::model_of("damped_oscillator");
  const std::vector<double> grid = instants(30, 30);  // transients have died out to e^(-60) by then
  const Simulation motion =
      simulate(Dynamics(model, {"cos(3*t)"}), test::request_for(*model, {{"b", b}}, grid));
  const std::complex<double> amplitude = F / std::complex<double>(k - m * w * w, b * w);
  EXPECT_NEAR(motion.y[0], (amplitude * std::polar(1.0, w * 30)).real(), closed_form);
}

TEST(ChargeInAMagneticField, GoesRoundOnItsCyclotronHelix) {
  const double w = 0.002 * 0.5 / 0.001, v = 1;  // charge B/m
  const std::vector<double> grid = instants(4 * pi / w, 40);
  const Simulation motion = test::motion_of("magnetic_particle", {}, grid);
  ASSERT_EQ(motion.rows, grid.size());
  for (std::size_t i = 0; i < motion.rows; ++i) {
    EXPECT_NEAR(row(motion, i)[0], v / w * std::sin(w * grid[i]), closed_form);
    EXPECT_NEAR(row(motion, i)[1], v / w * (std::cos(w * grid[i]) - 1), closed_form);
    EXPECT_NEAR(row(motion, i)[2], 0.1 * grid[i], closed_form);
  }
}

/// In the plane that turns with -Omega sin(latitude), x + i y oscillates with omega^2 = g/l + (Omega sin)^2.
TEST(FoucaultsPendulum, TurnsItsPlaneByOmegaTimesTheSineOfTheLatitude) {
  const double turning = 7.292115e-5 * std::sin(0.8527);
  const double omega = std::sqrt(9.81 / 67 + turning * turning);
  const std::vector<double> grid = instants(3600, 60);
  const Simulation motion = test::motion_of("foucault", {}, grid);
  ASSERT_EQ(motion.rows, grid.size());
  for (std::size_t i = 0; i < motion.rows; ++i) {
    const double t = grid[i];
    const std::complex<double> in_plane{3 * std::cos(omega * t), 3 * turning / omega * std::sin(omega * t)};
    const std::complex<double> z = in_plane * std::polar(1.0, -turning * t);
    EXPECT_NEAR(row(motion, i)[0], z.real(), 100 * closed_form);  // after 200 periods
    EXPECT_NEAR(row(motion, i)[1], z.imag(), 100 * closed_form);
  }
}

TEST(PlanePendulum, PassesTheBottomAfterAQuarterOfItsPeriod) {
  const double quarter = std::comp_ellint_1(std::sin(0.5)) * std::sqrt(0.8 / 9.81);
  const auto model = test::model_of("plane_pendulum");
  SimulationRequest request = test::request_for(*model, {}, {0, 2.5 * quarter});
  request.events = {"theta = 0-", "theta = 0", "theta = 0+"};
  const Simulation motion = simulate(Dynamics(model), request);
  ASSERT_EQ(motion.events.size(), 2u);  // the last one waits for the way back
  EXPECT_NEAR(motion.events[0].t, quarter, closed_form);
  EXPECT_NEAR(motion.events[0].y[1], -std::sqrt(2 * 9.81 / 0.8 * (1 - std::cos(1))), closed_form);
}

TEST(SphericalPendulum, StaysOnItsConeAtTheRightRate) {
  const double theta = 0.7, rate = std::sqrt(9.81 / 0.8 / std::cos(theta));
  const std::vector<double> grid = instants(5, 20);
  const Simulation motion =
      test::motion_of("spherical_pendulum", {{"theta", theta}, {"phi_dot", rate}}, grid);
  ASSERT_EQ(motion.rows, grid.size());
  for (std::size_t i = 0; i < motion.rows; ++i) {
    EXPECT_NEAR(row(motion, i)[0], theta, closed_form);
    EXPECT_NEAR(row(motion, i)[1], rate * grid[i], closed_form);
  }
}

TEST(BeadOnAHoop, StaysAsideAboveTheCriticalRate) {
  const double W = 8, theta = std::acos(9.81 / (0.3 * W * W));
  const auto model = test::model_of("bead_on_hoop");
  const Dynamics dynamics(model);
  const SimulationRequest at_rest = test::request_for(*model, {{"theta", theta}}, {0, 1});
  Workspace workspace = dynamics.jacobian().bind(at_rest.parameters);
  std::vector<double> slopes(4);
  ASSERT_EQ(dynamics.jacobian().evaluate(0, at_rest.y_start, workspace, slopes), Evaluation::ok);
  EXPECT_NEAR(-slopes[2], std::pow(W * std::sin(theta), 2), closed_form);  // omega^2 of small oscillations
  EXPECT_NEAR(simulate(dynamics, at_rest).y[0], theta, closed_form);
}

TEST(DrivenPivot, HoldsThePendulumUprightWhenShakenFast) {
  const auto farthest_from_upright = [](double w) {
    double farthest = 0;
    const Simulation motion = test::motion_of("driven_pivot", {{"w", w}}, instants(5, 500));
    for (std::size_t i = 0; i < motion.rows; ++i)
      farthest = std::max(farthest, std::abs(row(motion, i)[0] - pi));
    return farthest;
  };
  const double critical = std::sqrt(2 * 9.81 * 0.2) / 0.02;  // a^2 w^2 = 2 g l
  EXPECT_LT(farthest_from_upright(1.5 * critical), 0.5);
  EXPECT_GT(farthest_from_upright(0.5 * critical), 2);
}

/// l omega^2/g of the small oscillations are the zeros of L_3(x) = 1 - 3 x + 3/2 x^2 - x^3/6.
TEST(TriplePendulum, HasTheZerosOfALaguerrePolynomialForFrequencies) {
  const auto model = test::model_of("triple_pendulum");
  const Dynamics dynamics(model);
  const SimulationRequest hanging = test::request_for(*model, {{"q1", 0}, {"q2", 0}, {"q3", 0}}, {0});
  Workspace workspace = dynamics.jacobian().bind(hanging.parameters);
  std::vector<double> j(36);
  ASSERT_EQ(dynamics.jacobian().evaluate(0, hanging.y_start, workspace, j), Evaluation::ok);
  const double unit = 9.81 / 0.3;
  for (const double x : {0.0, 1.0, 2.0, 5.0}) {  // a polynomial of third degree is known by four values
    double m[3][3];
    for (std::size_t r = 0; r < 3; ++r) {
      for (std::size_t c = 0; c < 3; ++c) m[r][c] = -j[(3 + r) * 6 + c] / unit - (r == c ? x : 0);
    }
    const double determinant = m[0][0] * (m[1][1] * m[2][2] - m[1][2] * m[2][1]) -
                               m[0][1] * (m[1][0] * m[2][2] - m[1][2] * m[2][0]) +
                               m[0][2] * (m[1][0] * m[2][1] - m[1][1] * m[2][0]);
    EXPECT_NEAR(determinant / 6, 1 - 3 * x + 1.5 * x * x - x * x * x / 6, 1e-13);
  }
}

}  // namespace
}  // namespace qdot
