// Thousands of periods: what round-off does to the energy.

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "tests/support/motions.hpp"

namespace qdot {
namespace {

/// Mean squares, over several pendulums, of what is added to the energy over m g l in a sixteenth of the time
/// and in all of it.
struct Drift {
  double part{}, whole{};
};

Drift drift_of(const Tolerances& tolerances, double periods, double l = 1) {
  constexpr int motions = 24, parts = 16, rows = 1600;
  const auto model = test::model_of("plane_pendulum");
  const Dynamics dynamics(model);
  const double period = 2 * std::numbers::pi * std::sqrt(l / 9.81);
  Drift drift;
  for (int i = 0; i < motions; ++i) {
    SimulationRequest request = test::request_for(*model, {{"m", 1}, {"l", l}, {"theta", 0.4 + 0.1 * i}},
                                                  test::instants(periods * period, rows));
    request.method = Method::taylor;
    request.tolerances = tolerances;
    request.limits.max_steps = request.limits.max_evaluations = 100'000'000;
    request.columns = {{"energy", "J", *model->energy}};
    const std::vector<double> energy = simulate(dynamics, request).columns;
    const auto added = [&](int from, int to) {
      const double change = energy[static_cast<std::size_t>(to)] - energy[static_cast<std::size_t>(from)];
      return std::pow(change / (9.81 * l), 2);
    };
    for (int part = 0; part < parts; ++part) {
      drift.part += added(part * rows / parts, (part + 1) * rows / parts) / parts / motions;
    }
    drift.whole += added(0, rows) / motions;
  }
  return drift;
}

/// A random walk's mean square grows like the time, 16 times here; that of a steady drift 256 times.
TEST(LongMotion, EnergyOfTaylorWalksAtRoundOff) {
  const Drift drift = drift_of({1e-14, 1e-17}, 4'000);
  EXPECT_LT(std::sqrt(drift.whole), 4e-14);
  EXPECT_LT(drift.whole, 48 * drift.part);
}

/// Neither g/l nor l^2 is a double here: all coefficients of a step must take the same double for it.
TEST(LongMotion, EnergyOfTaylorWalksWhereConstantsAreRounded) {
  const Drift drift = drift_of({1e-14, 1e-17}, 4'000, 0.8);
  EXPECT_LT(std::sqrt(drift.whole), 4e-14);
  EXPECT_LT(drift.whole, 48 * drift.part);
}

TEST(LongMotion, TruncationDriftsSteadily) {
  const Drift drift = drift_of({1e-10, 1e-13}, 500);
  EXPECT_GT(drift.whole, 200 * drift.part);
}

}  // namespace
}  // namespace qdot
