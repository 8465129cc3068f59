// What a check that is given up tells of the error at the end.

#include "core/motion/error_growth.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "tests/support/motions.hpp"

namespace qdot {
namespace {

constexpr double span = 100, wanted = 1e-4;

/// A check whose angle is error(t) off, row by row until it is given up.
class Growing {
 public:
  explicit Growing(std::function<double(double)> error)
      : dynamics_(test::model_of("plane_pendulum")),
        request_(test::request_for(dynamics_.model(), {}, test::instants(span, 400))),
        grid_(request_) {
    simulation_.rows = grid_.t.size();
    simulation_.states.resize(2 * simulation_.rows);
    const ComputedMotion motion{dynamics_, request_, grid_, simulation_, {}, false};
    ErrorGrowth growth(motion, {wanted, wanted});
    goes_on = true;
    for (rows = 0; rows < simulation_.rows && goes_on; ++rows)
      goes_on = growth.add(rows, std::vector{error(grid_.t[rows]), 0.0});
    expected = growth.expected();
    at_end = safety * error(span) / wanted;
  }

  bool goes_on{};
  std::size_t rows{};         ///< that were looked at
  double expected{}, at_end;  ///< errors at the end, in units of what is wanted

 private:
  static constexpr double safety = 2;  ///< times the difference is the error
  Dynamics dynamics_;
  SimulationRequest request_;
  DenseGrid grid_;
  Simulation simulation_;
};

TEST(ErrorGrowth, ADriftingPhaseIsExpectedToDriftOn) {
  const Growing drift([](double t) { return 1e-3 * std::pow(t / span, 2); });
  EXPECT_FALSE(drift.goes_on);
  EXPECT_LT(drift.rows, 100U);
  EXPECT_NEAR(drift.expected, drift.at_end, 0.02 * drift.at_end);
}

TEST(ErrorGrowth, ChaosGrowsExponentially) {
  const Growing chaos([](double t) { return 1e-7 * std::exp(0.2 * t); });
  EXPECT_FALSE(chaos.goes_on);
  EXPECT_NEAR(std::log(chaos.expected), std::log(chaos.at_end), 0.5);
}

TEST(ErrorGrowth, WhatIsPassedInTheSecondHalfIsMeasuredToTheEnd) {
  const Growing late([](double t) { return 1e-4 * std::pow(t / span, 2); });
  EXPECT_GT(late.at_end, 1);
  EXPECT_TRUE(late.goes_on);
}

TEST(ErrorGrowth, NothingIsExpectedFromTheFirstMoments) {
  const Growing early([](double t) { return t == 0.25 ? 1.0 : 1e-8; });
  EXPECT_FALSE(early.goes_on);
  EXPECT_GT(early.rows, 50U);
}

}  // namespace
}  // namespace qdot
