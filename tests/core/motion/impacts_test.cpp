// Balls that bounce, whose motions are known: none falls through its floor, and their errors hold.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/motion/ladder.hpp"
#include "tests/support/motions.hpp"

namespace qdot {
namespace {

constexpr double earth_gravity = 9.81;

MeasuredSimulation measured(const Model& model, const Values& given, std::vector<double> grid,
                            Method method) {
  SimulationRequest request = test::request_for(model, given, std::move(grid));
  request.method = method;
  request.tolerances = {1e-9, 1e-12};
  return simulate_with_error(Dynamics(std::make_shared<const Model>(model)), request, {});
}

/// A ball on a slope of this steepness, with the height `h` above it at the start.
Scene ball_on_slope(double steepness, double e) {
  Scene scene;
  scene.name = "slope";
  scene.parameters = {{"m", "kg", "1", {}, "", ""},
                      {"g", "m/s^2", "9.81", {}, "", ""},
                      {"s", "1", std::to_string(steepness), {}, "", ""}};
  scene.coordinates = {{"x", "m", "0.7", "0.1", "", {}, "", ""}, {"y", "m", "1.9", "-0.2", "", {}, "", ""}};
  scene.points = {{"ball", {"x", "y"}}};
  scene.bodies = {Particle{"ball", "m", {"ball", {}}}};
  scene.gravity = {"0", "-g"};
  scene.events = {{"hit", "y + s*x", Crossing::falling, {}, {}}};
  Impact impact;
  impact.event = "hit";
  impact.restitution = std::to_string(e);
  scene.impacts = {impact};
  return scene;
}

/// When a ball comes to rest that is at height h and rises with v under gravity g.
double end_of_bounces(double h, double v, double gravity, double e) {
  const double fall = std::sqrt(v * v + 2 * gravity * h);
  return (v + fall + 2 * fall * e / (1 - e)) / gravity;
}

/// Two computations meet an impact at instants that differ by their errors; a row in between is before it in
/// one, and after it in the other.
TEST(Impacts, AtRowsDoNotMakeTheMotionUncertain) {
  const auto model = build_model(ball_on_slope(0, 1));
  const double fall = std::sqrt(0.04 + 2 * earth_gravity * 1.9), first = (fall - 0.2) / earth_gravity;
  std::vector<double> rows{0};
  for (int i = 0; i < 20; ++i) rows.push_back(first + i * 2 * fall / earth_gravity);
  rows.push_back(40);
  for (const Method method : {Method::taylor, Method::erk, Method::adams}) {
    const MeasuredSimulation m = measured(*model, {}, rows, method);
    ASSERT_EQ(m.max_abs_error.size(), 4U);
    EXPECT_LT(m.max_abs_error[1], 1e-4) << static_cast<int>(method);
    EXPECT_LT(m.max_abs_error[3], 1e-4) << static_cast<int>(method);
    EXPECT_GT(m.at_impacts.size(), 12U) << static_cast<int>(method);
    for (const double t : m.at_impacts) EXPECT_TRUE(std::ranges::count(rows, t) == 1 && t > 0 && t < 40);
  }
}

TEST(Impacts, AccumulateByEveryMethod) {
  for (const Method method : test::all_methods) {
    for (const double e : {0.0, 1e-6, 0.1, 0.5, 0.7}) {
      const auto model = build_model(ball_on_slope(0, e));
      const MeasuredSimulation m = measured(*model, {}, test::instants(20, 4), method);
      ASSERT_TRUE(m.simulation.stop) << static_cast<int>(method) << " " << e;
      EXPECT_EQ(m.simulation.stop->reason, "impacts_accumulate");
      ASSERT_TRUE(m.stop_error);
      EXPECT_LE(std::abs(m.simulation.stop->t - end_of_bounces(1.9, -0.2, earth_gravity, e)),
                m.stop_error->time)
          << static_cast<int>(method) << " " << e;
      EXPECT_LE(m.stop_error->time, 5e-4);
    }
  }
}

TEST(Impacts, AccumulateOnASlopeAtATimeWithinItsError) {
  int told = 0;
  for (const double steepness : {0.25, 0.75, 1.5}) {
    for (const double e : {0.002, 0.05, 0.27, 0.5, 0.7, 0.82}) {
      const auto model = build_model(ball_on_slope(steepness, e));
      const double normal = std::hypot(1, steepness);
      const double end = end_of_bounces((1.9 + 0.7 * steepness) / normal, (-0.2 + 0.1 * steepness) / normal,
                                        earth_gravity / normal, e);
      const MeasuredSimulation m = measured(*model, {}, test::instants(40, 4), Method::taylor);
      ASSERT_TRUE(m.simulation.stop) << steepness << " " << e;
      if (!m.stop_error) continue;
      ++told;
      EXPECT_LE(std::abs(m.simulation.stop->t - end), m.stop_error->time) << steepness << " " << e;
    }
  }
  EXPECT_GE(told, 9);
}

/// It slides so far that its distance is rounded more than its last flights are high: those go on by chance,
/// and no longer shrink.
TEST(Impacts, AccumulateWhereTheLastFlightsAreLowerThanRounding) {
  struct Slope {
    double steepness, e, y, x_dot, y_dot;
  };
  for (const auto& [steepness, e, y, x_dot, y_dot] :
       {Slope{1.41, 0.59, 0.9192, -0.1, 0.79}, Slope{-0.97, 0.7, 1.3241, 1.61, 1.84}}) {
    Scene scene;
    scene.name = "slope";
    scene.without_units = true;
    scene.coordinates = {Coordinate{"x", "1", "0", "0", {}, {}, {}, {}},
                         Coordinate{"y", "1", "0", "0", {}, {}, {}, {}}};
    scene.parameters = {{"s", "1", std::to_string(steepness), {}, "", ""},
                        {"e", "1", std::to_string(e), {}, "", ""}};
    scene.lagrangian = "(x_dot^2 + y_dot^2)/2 - 9.61*y";
    scene.events = {{"hit", "y - s*x", Crossing::falling, {}, {}}};
    scene.impacts.push_back(ball_on_slope(0, 1).impacts[0]);
    scene.impacts[0].event = "hit";
    scene.impacts[0].restitution = "e";
    const auto model = build_model(scene);
    const MeasuredSimulation m = measured(*model, {{"x", 0.12}, {"y", y}, {"x_dot", x_dot}, {"y_dot", y_dot}},
                                          {0, 18}, Method::taylor);
    ASSERT_TRUE(m.simulation.stop) << steepness;
    EXPECT_LT(m.simulation.events.size(), 100U);
    ASSERT_TRUE(m.stop_error);
    const double end = end_of_bounces(y - steepness * 0.12, y_dot - steepness * x_dot, 9.61, e);
    EXPECT_NEAR(m.simulation.stop->t, end, m.stop_error->time);
    EXPECT_LT(m.stop_error->time, 1e-4);
  }
}

/// A ball that keeps its speed v between two floors, L apart: x = v t, folded.
TEST(Impacts, LeaveTheRoundingOfTheirInstantsInDoubt) {
  Scene scene = ball_on_slope(0, 1);
  scene.gravity = {"0", "0"};
  scene.parameters.push_back({"L", "m", "1.27", {}, "", ""});
  scene.events.push_back({"top", "L - y", Crossing::falling, {}, {}});
  scene.impacts.push_back(scene.impacts[0]);
  scene.impacts[1].event = "top";
  const auto model = build_model(scene);
  const std::vector<double> grid = test::instants(30, 120);
  for (const double v : {1.706, 2.3, 0.917}) {
    const MeasuredSimulation m = measured(*model, {{"y", 0.2564}, {"y_dot", v}}, grid, Method::taylor);
    ASSERT_EQ(m.simulation.rows, grid.size());
    for (std::size_t i = 0; i < grid.size(); ++i) {
      const long double way = 0.2564L + static_cast<long double>(v) * grid[i], there = std::fmod(way, 2.54L);
      const long double y = there < 1.27L ? there : 2.54L - there;
      EXPECT_LE(std::abs(static_cast<double>(test::row(m.simulation, i)[1] - y)), m.max_abs_error[1]) << v;
    }
  }
}

/// From y = h at rest it hits with sqrt(2 g h); what is left of that lies above 1 m/s, and falls through it.
TEST(Impacts, PassNoEventBetweenTheStatesBeforeAndAfter) {
  constexpr double e = 0.9, height = 1;
  Scene scene = ball_on_slope(0, e);
  scene.parameters.push_back({"w", "m/s", "1", {}, "", ""});
  scene.events.push_back({"slow", "y_dot - w", Crossing::either, {}, {}});
  scene.events.push_back({"rises", "y_dot", Crossing::rising, {}, {}});
  const auto model = build_model(scene);
  SimulationRequest request = test::request_for(*model, {{"y", height}, {"y_dot", 0}}, {0, 1.5});
  request.method = Method::taylor;
  request.events = {"slow", "rises"};
  const Dynamics dynamics(std::make_shared<const Model>(*model));
  const MeasuredSimulation m = simulate_with_error(dynamics, request, {});
  const double speed = std::sqrt(2 * earth_gravity * height), first = speed / earth_gravity;
  const std::vector<EventRecord>& events = m.simulation.events;
  ASSERT_EQ(events.size(), 3U);
  EXPECT_EQ(events[0].name, "hit");
  EXPECT_EQ(events[1].name, "slow");
  EXPECT_NEAR(events[1].t, first + (e * speed - 1) / earth_gravity, 1e-9);
  EXPECT_EQ(events[2].name, "hit");
  for (const auto& error : m.event_errors) EXPECT_TRUE(error.has_value());
  EXPECT_EQ(m.reason, "");
}

}  // namespace
}  // namespace qdot
