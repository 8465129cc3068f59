// A drive whose phase w t + p is much larger than what it turns by: most of its digits are lost, and alike in
// every computation that begins at the same instant.

#include <gtest/gtest.h>

#include <cmath>

#include "core/motion/ladder.hpp"
#include "tests/support/motions.hpp"

namespace qdot {
namespace {

constexpr long double w = 0.0234378L, p = 1000000.25L;

class DrivePhase : public testing::Test {
 protected:
  /// Under `drive` from rest, x'' = +-cos(w t + p), over `duration` from each of 200 instants: x' is within
  /// its stated error of the integral. Over zeros of the drive only where `over_zeros`.
  void expect_within(const std::string& drive, double duration, double rtol, bool over_zeros) {
    const Dynamics dynamics(model_, {drive});
    int asked = 0;
    for (double t = -500; t < -400; t += 0.5) {
      const long double begin = w * t + p, end = w * (t + duration) + p;
      if (!over_zeros && std::cos(begin) * std::cos(end) < 0) continue;
      SimulationRequest request =
          test::request_for(*model_, {{"m", 1}, {"b", 0}, {"k", 0}, {"x", 0}}, {t, t + duration});
      request.t_start = t;
      request.method = Method::taylor;
      request.tolerances = {rtol, rtol * 1e-3};
      const auto found = simulate_with_error(dynamics, request, {});
      ASSERT_EQ(found.max_abs_error.size(), 2u) << t;
      const long double v = (std::sin(end) - std::sin(begin)) / w;
      const double is = test::row(found.simulation, 1)[1];
      const long double error = over_zeros ? is - v : is - std::abs(v);
      EXPECT_LE(std::abs(static_cast<double>(error)), found.max_abs_error[1]) << t;
      ++asked;
    }
    EXPECT_GT(asked, 100);
  }

  std::shared_ptr<const Model> model_ = build_model(test::scene_of("damped_oscillator"));
};

TEST_F(DrivePhase, IsNoSecretWhereTheDriveHasKinks) {
  expect_within("abs(cos(0.0234378*t + 1000000.25))", 4, 1e-12, false);
}

TEST_F(DrivePhase, IsNoSecretWhereFewStepsRoundAlikeByChance) {
  expect_within("cos(0.0234378*t + 1000000.25)", 40, 2e-12, true);
}

}  // namespace
}  // namespace qdot
