// Turning points against closed forms, and against the extrema of motions that are followed.

#include "core/turning/turning_points.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <numbers>

#include "core/base/error.hpp"
#include "core/motion/trajectory_extrema.hpp"
#include "tests/support/random.hpp"
#include "tests/support/scenes.hpp"

namespace qdot {
namespace {

using std::numbers::pi;

const Dynamics& dynamics_of(const std::string& system) {
  static std::map<std::string, std::unique_ptr<const Dynamics>> kept;
  auto& slot = kept[system];
  if (!slot) slot = std::make_unique<const Dynamics>(test::model_of(system));
  return *slot;
}

struct Start {
  std::vector<double> parameters, y;
};

Start start_of(const std::string& system, const Values& parameters, const Values& initial) {
  const Model& model = dynamics_of(system).model();
  Start start;
  start.parameters = parameter_values(model, parameters);
  start.y = initial_state(model, start.parameters, initial);
  return start;
}

TurningPoints points(const std::string& system, const Values& parameters, const Values& initial) {
  const Start start = start_of(system, parameters, initial);
  return turning_points(dynamics_of(system), start.parameters, start.y);
}

/// The extremum within its stated error of the true value, and that error a few roundings.
void expect_extremum(const Finding& found, long double expected, double relative = 1e-14) {
  ASSERT_TRUE(found.value.has_value()) << found.reason;
  const auto off = static_cast<double>(std::abs(*found.value - expected));
  EXPECT_LE(off, found.error + 1e-19 * static_cast<double>(std::abs(expected))) << *found.value;
  EXPECT_LE(found.error, relative * static_cast<double>(std::abs(expected)) + 1e-300) << *found.value;
}

/// 4 K(m)/omega by the arithmetic-geometric mean, sin(amplitude/2)^2 = m.
double pendulum_period(double omega, double amplitude) {
  long double a = 1, b = std::cos(static_cast<long double>(amplitude) / 2);
  for (int i = 0; i < 10; ++i) {
    const long double mean = (a + b) / 2;
    b = std::sqrt(a * b);
    a = mean;
  }
  return static_cast<double>(2 * std::numbers::pi_v<long double> / (omega * a));
}

TEST(TurningPoints, OfTheOrbitingPendulumIsSixtyDegrees) {
  const TurningPoints found =
      points("orbiting_pendulum", {{"m", 0.5}, {"l", 0.8}, {"r", 0.8}, {"omega0", 2}}, {{"phi_dot", 2}});
  EXPECT_EQ(found.motion, MotionKind::libration);
  EXPECT_EQ(found.initial, InitialPlace::between);
  expect_extremum(found.maximum, std::numbers::pi_v<long double> / 3);
  expect_extremum(found.minimum, -std::numbers::pi_v<long double> / 3);
  EXPECT_NEAR(*found.energy.value, -1.92, found.energy.error + 1e-15);  // 0.8 is taken for its double
  EXPECT_NEAR(*found.period.value, 6.7430014192503842 / 2, 1e-14);
  ASSERT_EQ(found.validity.size(), 1u);
  EXPECT_NEAR(*found.validity[0].value, 5.0 / 6 * 0.5 * 0.8 * 4, 1e-13);  // S_min = (5/6) m l omega0^2
  EXPECT_NEAR(found.validity[0].x_dot, -2.0 / 3 * 2, 1e-5);               // flat there
}

TEST(TurningPoints, OfTheOrbitingPendulumFollowTheirFormula) {
  test::Random random(7);
  int librations = 0, rotations = 0;
  for (int i = 0; i < 300; ++i) {
    const double l = random.real(0.1, 3), r = random.real(0.1, 3), omega0 = random.real(-3, 3);
    const double phi = random.real(-3, 3), phi_dot = random.real(-3, 3);
    const TurningPoints found = points("orbiting_pendulum", {{"l", l}, {"r", r}, {"omega0", omega0}},
                                       {{"phi", phi}, {"phi_dot", phi_dot}});
    const long double cosine = std::cos(static_cast<long double>(phi)) -
                               static_cast<long double>(l) * phi_dot * phi_dot / (2.0L * r * omega0 * omega0);
    if (cosine > -1) {
      ++librations;
      EXPECT_EQ(found.motion, MotionKind::libration);
      const double steepness = 1e-14 / static_cast<double>(std::sqrt(1 - cosine * cosine));
      expect_extremum(found.maximum, std::acos(cosine), 1e-14 + steepness);
      expect_extremum(found.minimum, -std::acos(cosine), 1e-14 + steepness);
      const double amplitude = *found.maximum.value;
      const double period = pendulum_period(std::abs(omega0) * std::sqrt(r / l), amplitude);
      ASSERT_TRUE(found.period.value);
      EXPECT_NEAR(*found.period.value, period, found.period.error + 1e-14 * period);
      EXPECT_LT(found.period.error, 1e-10 * period);
    } else {
      ++rotations;
      EXPECT_EQ(found.motion, MotionKind::rotation);
      EXPECT_FALSE(found.maximum.value || found.minimum.value);
      EXPECT_THAT(found.maximum.reason, testing::HasSubstr("never turns"));
    }
  }
  EXPECT_GT(librations, 100);
  EXPECT_GT(rotations, 50);
}

TEST(TurningPoints, OfSmallOscillationsKeepAllDigits) {
  for (const double a : {1e-2, 1e-4, 1e-6, 1e-8, 1e-12}) {
    const TurningPoints found = points("plane_pendulum", {}, {{"theta", a}});
    EXPECT_EQ(found.motion, MotionKind::libration);
    EXPECT_EQ(found.initial, InitialPlace::maximum);
    EXPECT_EQ(*found.maximum.value, a);
    EXPECT_EQ(found.maximum.error, 0);
    expect_extremum(found.minimum, -a);
    EXPECT_NEAR(*found.period.value, pendulum_period(std::sqrt(9.81 / 0.8), a), 1e-13);
    const TurningPoints moving = points("plane_pendulum", {}, {{"theta", 0}, {"theta_dot", a}});
    expect_extremum(moving.maximum, 2 * std::asin(a / 2 / std::sqrt(9.81L / 0.8)));
  }
}

TEST(TurningPoints, OfTheFreeSpinPendulumAreThePracticeSheets) {
  const TurningPoints seed =
      points("free_spin_pendulum", {{"m", 1}, {"l", 2.4525}, {"g", 9.81}}, {{"theta", 0}, {"psi_dot", 4}});
  EXPECT_EQ(seed.initial, InitialPlace::minimum);
  EXPECT_EQ(*seed.minimum.value, 0);
  expect_extremum(seed.maximum, 0.962233337506167438619053920168L, 2e-14);
  const TurningPoints general = points("free_spin_pendulum", {{"m", 1.7}, {"l", 0.9}, {"g", 9.81}},
                                       {{"theta", 0.3}, {"theta_dot", 0.5}, {"psi_dot", 3}});
  EXPECT_EQ(general.motion, MotionKind::libration);
  EXPECT_NEAR(general.momenta[0], 2.6143132611220534, 1e-14);
  EXPECT_NEAR(*general.energy.value, -10.24533707454988, 1e-13);
  EXPECT_NEAR(*general.maximum.value, 0.5905234546537318, 2e-15);
  EXPECT_NEAR(*general.minimum.value, 0.27019549033656415, 1e-15);
}

TEST(TurningPoints, OfTheFreeSpinPendulumSolveTheirEquation) {
  test::Random random(8);
  for (int i = 0; i < 200; ++i) {
    const double l = random.real(0.2, 2), g = random.real(0, 10), theta = random.real(-0.4, 2.5);
    const double theta_dot = random.real(-3, 3), psi_dot = random.real(0.1, 6);
    const TurningPoints found = points("free_spin_pendulum", {{"l", l}, {"g", g}},
                                       {{"theta", theta}, {"theta_dot", theta_dot}, {"psi_dot", psi_dot}});
    ASSERT_TRUE(found.maximum.value && found.minimum.value) << found.motion_reason;
    const auto a = [](long double x) { return 0.5L + std::sin(x); };
    const long double b = a(theta) * a(theta) * psi_dot;
    const auto f = [&](long double x) {  // physics: theta'^2/2 at x
      return theta_dot * static_cast<long double>(theta_dot) / 2 +
             b * b / 2 * (1 / (a(theta) * a(theta)) - 1 / (a(x) * a(x))) -
             static_cast<long double>(g) / l * (std::cos(static_cast<long double>(theta)) - std::cos(x));
    };
    for (const Finding& bound : {found.maximum, found.minimum}) {
      const long double x = *bound.value, reach = bound.error + 1e-17L;
      EXPECT_LE(f(x - reach) * f(x + reach), 0) << static_cast<double>(x) << " +- " << bound.error;
      EXPECT_LT(bound.error, 1e-12);
    }
  }
}

TEST(TurningPoints, AreTheExtremaOfMotionsThatAreFollowed) {
  const std::map<std::string, std::vector<std::string>> starts{
      {"whirling_pendulum", {"theta"}},         {"rotating_l_bar", {"theta"}}, {"orbiting_pendulum", {"phi"}},
      {"free_spin_pendulum", {"theta", "psi"}}, {"bead_on_hoop", {"theta"}},   {"kepler", {"r", "theta"}}};
  test::Random random(9);
  int compared = 0;
  for (const auto& [system, names] : starts) {
    for (int i = 0; i < 25; ++i) {
      Values initial;
      const std::string& q = names[0];
      initial[q] = q == "r" ? random.real(0.5, 2) : random.real(-0.4, 1.5);
      initial[q + "_dot"] = random.real(-1, 1);
      if (names.size() > 1) initial[names[1] + "_dot"] = random.real(0.5, 3);
      const Start start = start_of(system, {}, initial);
      const TurningPoints found = turning_points(dynamics_of(system), start.parameters, start.y);
      if (found.motion != MotionKind::libration || !found.period.value) continue;
      const TrajectoryExtrema followed =
          trajectory_extrema(dynamics_of(system), {.parameters = start.parameters,
                                                   .y_start = start.y,
                                                   .coordinate = found.coordinate,
                                                   .t_start = 0,
                                                   .t_end = 1.1 * *found.period.value,
                                                   .on_invalid = OnInvalid::go_on,
                                                   .impacts = Impacts::apply,
                                                   .limits = {}});
      ASSERT_EQ(followed.ending, Ending::reached_end);
      EXPECT_NEAR(*followed.maximum.value, *found.maximum.value, followed.maximum.error + 1e-11) << system;
      EXPECT_NEAR(*followed.minimum.value, *found.minimum.value, followed.minimum.error + 1e-11) << system;
      EXPECT_EQ(std::abs(*followed.maximum.value - *found.maximum.value) < 1e-8, true) << system;
      ++compared;
    }
  }
  EXPECT_GT(compared, 90);
}

TEST(TurningPoints, TellTheSeparatrixFromItsNeighbours) {
  const double g = 9.81, l = 0.8;
  const auto kick = [&](double factor) {
    return points("plane_pendulum", {{"g", g}, {"l", l}},
                  {{"theta", 0}, {"theta_dot", 2 * std::sqrt(g / l) * factor}});
  };
  const TurningPoints exact = kick(1);
  EXPECT_EQ(exact.motion, MotionKind::separatrix);
  EXPECT_NEAR(*exact.maximum.value, pi, exact.maximum.error);
  EXPECT_FALSE(exact.period.value);
  for (const double off : {1e-12, 1e-13, 1e-6}) {
    EXPECT_EQ(kick(1 + off).motion, MotionKind::rotation) << off;
    const TurningPoints below = kick(1 - off);
    EXPECT_EQ(below.motion, MotionKind::libration) << off;
    // sin(theta/2) = 1 - off; the rate itself is rounded.
    const double expected = pi - 2 * std::acos(1 - off);
    EXPECT_NEAR(*below.maximum.value, expected, below.maximum.error + 3e-16 / std::sqrt(off));
    EXPECT_LT(below.maximum.error, 3e-15 / std::sqrt(off));
  }
  const TurningPoints top = points("plane_pendulum", {}, {{"theta", pi}, {"theta_dot", 1e-3}});
  EXPECT_EQ(top.motion, MotionKind::rotation);
}

TEST(TurningPoints, OfRest) {
  const TurningPoints bottom = points("plane_pendulum", {}, {{"theta", 0}});
  EXPECT_EQ(bottom.motion, MotionKind::equilibrium);
  EXPECT_EQ(bottom.stability, "stable");
  EXPECT_EQ(*bottom.maximum.value, 0);
  EXPECT_EQ(*bottom.minimum.value, 0);
  const Start at_pi = start_of("plane_pendulum", {}, {{"theta", pi}});
  Reals y = at_pi.y;
  y.set(0, exact_pi);
  const TurningPoints top = turning_points(dynamics_of("plane_pendulum"), at_pi.parameters, y);
  EXPECT_EQ(top.motion, MotionKind::equilibrium);
  EXPECT_EQ(top.stability, "unstable");
  EXPECT_EQ(*top.maximum.value, pi);
  const TurningPoints beside = points("plane_pendulum", {}, {{"theta", pi}});  // a double is less than pi
  EXPECT_EQ(beside.motion, MotionKind::separatrix);
  expect_extremum(beside.minimum, -std::numbers::pi_v<long double>);
  EXPECT_THAT(beside.minimum.reason, testing::HasSubstr("as far as double precision tells"));
  const TurningPoints weightless = points("plane_pendulum", {{"g", 0}}, {{"theta", 0.3}});
  EXPECT_EQ(weightless.motion, MotionKind::equilibrium);
  EXPECT_EQ(weightless.stability, "neutral");
  const TurningPoints cone = points("free_spin_pendulum", {{"m", 1.7}, {"l", 0.9}, {"g", 9.81}},
                                    {{"theta", 0.6}, {"psi_dot", 2.6465666375548724}});
  EXPECT_EQ(cone.motion, MotionKind::equilibrium);
  EXPECT_LT(cone.maximum.error, 1e-14);
}

TEST(TurningPoints, WithoutGravityOneTurnTakesTwoPiOverTheRate) {
  const TurningPoints found = points("plane_pendulum", {{"g", 0}}, {{"theta", 0.3}, {"theta_dot", -2}});
  EXPECT_EQ(found.motion, MotionKind::rotation);
  EXPECT_NEAR(*found.period.value, pi, 1e-14);
}

TEST(TurningPoints, AtTheCriticalRateOfTheWhirlingPendulum) {
  const double critical = std::sqrt(9.81 / 0.5);
  for (const double factor : {1.0, 1 - 1e-9, 1 + 1e-9}) {
    for (const double a : {1.0, 0.1, 1e-3}) {
      const TurningPoints found = points("whirling_pendulum", {{"Omega", critical * factor}}, {{"theta", a}});
      EXPECT_EQ(found.motion, MotionKind::libration);
      expect_extremum(found.minimum, -a, 4e-15 / (a * a * a));
    }
    const TurningPoints tiny = points("whirling_pendulum", {{"Omega", critical * factor}}, {{"theta", 1e-8}});
    if (tiny.minimum.value && factor <= 1) {
      EXPECT_NEAR(*tiny.minimum.value, -1e-8, tiny.minimum.error);
    } else if (!tiny.minimum.value) {
      EXPECT_THAT(tiny.minimum.reason, testing::HasSubstr("cannot be told"));
    }
  }
  // At Omega_c the potential is quartic: omega = 0.84721 a sqrt(g/(2 l)).
  const TurningPoints quartic = points("whirling_pendulum", {{"Omega", critical}}, {{"theta", 0.01}});
  EXPECT_NEAR(2 * pi / *quartic.period.value, 0.84721 * 0.01 * std::sqrt(9.81 / 1.0), 1e-6);
}

TEST(TurningPoints, AtTheAxisOfTheFreeSpinPendulum) {
  const TurningPoints plane = points("free_spin_pendulum", {}, {{"theta", 1}, {"psi_dot", 0}});
  EXPECT_EQ(plane.motion, MotionKind::libration);
  expect_extremum(plane.minimum, -1);
  ASSERT_EQ(plane.notes.size(), 1u);
  EXPECT_THAT(plane.notes[0], testing::HasSubstr("vertical axis"));
  for (const double psi_dot : {1e-3, 1e-6, 1e-9}) {
    const TurningPoints wall = points("free_spin_pendulum", {}, {{"theta", 1}, {"psi_dot", psi_dot}});
    EXPECT_EQ(wall.motion, MotionKind::libration);
    // A = b/sqrt(2 (G cos(theta) - G cos 1 + ...)) next to theta = -pi/6, where A' = cos(pi/6).
    const double b = std::pow(0.5 + std::sin(1.0), 2) * psi_dot;
    const double wall_at = b / std::sqrt(2 * 9.81 / 0.5 * (std::cos(pi / 6) - std::cos(1.0)));
    EXPECT_NEAR(*wall.minimum.value, -pi / 6 + wall_at / std::cos(pi / 6),
                1e-16 + wall_at * (1e-3 + psi_dot));
    EXPECT_TRUE(wall.notes.empty());
  }
  const TurningPoints across = points("free_spin_pendulum", {}, {{"theta", -1}, {"psi_dot", 2}});
  EXPECT_EQ(across.motion, MotionKind::libration);
  EXPECT_GT(*across.minimum.value, -5 * pi / 6);
  EXPECT_LT(*across.maximum.value, -pi / 6);
}

TEST(TurningPoints, DoNotDependOnTheMass) {
  const TurningPoints one = points("plane_pendulum", {{"m", 1}}, {{"theta", 0.3}, {"theta_dot", 1}});
  for (const double m : {1e-12, 1e12}) {
    const TurningPoints found = points("plane_pendulum", {{"m", m}}, {{"theta", 0.3}, {"theta_dot", 1}});
    EXPECT_NEAR(*found.maximum.value, *one.maximum.value, found.maximum.error + one.maximum.error);
  }
}

TEST(TurningPoints, OfAnOrbitAreItsApsides) {
  // r = 0.5 and r theta' = sqrt(3), rounded, for mu = 1: e = r v^2 - 1 near 1/2, a near 1, period near 2 pi.
  const TurningPoints ellipse = points("kepler", {}, {});
  const long double v = 0.5L * 3.4641016151377544, e = 0.5L * v * v - 1;
  expect_extremum(ellipse.maximum, 0.5L * (1 + e) / (1 - e), 4e-16);
  EXPECT_EQ(*ellipse.minimum.value, 0.5);
  EXPECT_NEAR(*ellipse.period.value, 2 * pi, 1e-13);
  const TurningPoints hyperbola = points("kepler", {}, {{"theta_dot", 5}});
  EXPECT_EQ(hyperbola.motion, MotionKind::unbounded);
  EXPECT_EQ(*hyperbola.minimum.value, 0.5);
  EXPECT_FALSE(hyperbola.maximum.value);
}

TEST(TurningPoints, OnTheTiltingPlatformWithoutGravityAreClosedForms) {
  // q'' = 2/3 Omega^2 q: q'^2 - 2/3 Omega^2 q^2 is constant.
  const double rate = std::sqrt(2.0 / 3) * 0.4;
  const Values parameters{{"g", 0}, {"Omega", 0.4}};
  const TurningPoints turns = points("rolling_disk_platform", parameters, {{"q", 0.5}, {"q_dot", -0.1}});
  EXPECT_EQ(turns.motion, MotionKind::unbounded);
  expect_extremum(turns.minimum, std::sqrt(0.25L - 0.1L * 0.1L / (2 * 0.16L / 3)), 1e-14);
  EXPECT_FALSE(turns.maximum.value);
  const TurningPoints passes = points("rolling_disk_platform", parameters, {{"q", 0.5}, {"q_dot", -rate}});
  EXPECT_FALSE(passes.maximum.value);
}

TEST(TurningPoints, AreNotAskedOfTheEnergyWhereItCannotAnswer) {
  const auto why = [](const std::string& system, std::size_t coordinate) {
    const Dynamics& dynamics = dynamics_of(system);
    return why_not_by_energy(dynamics, parameter_values(dynamics.model(), {}), coordinate);
  };
  EXPECT_EQ(why("plane_pendulum", 0), "");
  EXPECT_THAT(why("spring_pendulum", 0), testing::HasSubstr("more than one coordinate"));
  EXPECT_THAT(why("free_spin_pendulum", 1), testing::HasSubstr("ignorable"));
  EXPECT_THAT(why("driven_pivot", 0), testing::HasSubstr("time"));
  EXPECT_THAT(why("damped_oscillator", 0), testing::HasSubstr("forces"));
  const Start start = start_of("spring_pendulum", {}, {});
  EXPECT_THROW((void)turning_points(dynamics_of("spring_pendulum"), start.parameters, start.y), Error);
}

/// Of the first coordinate.
TrajectoryExtrema followed(const std::string& system, const Start& start, double t_end) {
  return trajectory_extrema(dynamics_of(system), {.parameters = start.parameters,
                                                  .y_start = start.y,
                                                  .coordinate = 0,
                                                  .t_start = 0,
                                                  .t_end = t_end,
                                                  .on_invalid = OnInvalid::stop,
                                                  .impacts = Impacts::apply,
                                                  .limits = {}});
}

TEST(TrajectoryExtrema, OfAnIsotropicOscillatorAreItsEllipses) {
  // l0 = 0: y oscillates about -m g/k with sqrt(k/m). Dropped at theta = 0 from l, the spring goes to 2 m g/k
  // - l.
  const Start start =
      start_of("spring_pendulum", {{"m", 1}, {"k", 20}, {"l0", 0}}, {{"l", 0.7}, {"theta", 0}});
  const TrajectoryExtrema found = followed("spring_pendulum", start, 3);
  EXPECT_NEAR(*found.minimum.value, 2 * 9.81 / 20 - 0.7, found.minimum.error);
  EXPECT_LT(found.minimum.error, 1e-9);
  EXPECT_NEAR(found.t_minimum, pi / std::sqrt(20.0), 1e-6);
  EXPECT_EQ(found.initial, InitialPlace::maximum);
}

TEST(TrajectoryExtrema, OfASmallMotionAreKnownByItsSize) {
  for (const double x0 : {1e-9, 1e-12, 1e-30}) {
    const Start start = start_of("damped_oscillator", {{"m", 1}, {"b", 0}, {"k", 3}}, {{"x", x0}});
    const TrajectoryExtrema found = followed("damped_oscillator", start, 50);
    EXPECT_NEAR(*found.minimum.value, -x0, found.minimum.error);
    EXPECT_LT(found.minimum.error, 1e-9 * x0);
  }
}

TEST(TurningPoints, AreTheSameBitsEveryTime) {
  const auto ask = [] { return points("free_spin_pendulum", {}, {{"theta", 0.3}, {"theta_dot", 0.2}}); };
  const TurningPoints one = ask(), two = ask();
  EXPECT_EQ(*one.maximum.value, *two.maximum.value);
  EXPECT_EQ(*one.period.value, *two.period.value);
}

}  // namespace
}  // namespace qdot
