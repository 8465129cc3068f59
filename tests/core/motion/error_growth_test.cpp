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
  explicit Growing(std::function<double(double)> error, const std::vector<double>& events = {})
      : dynamics_(test::model_of("plane_pendulum")),
        request_(test::request_for(dynamics_.model(), {}, test::instants(span, 400))),
        grid_(request_) {
    simulation_.rows = grid_.t.size();
    for (const double t : grid_.t) simulation_.states.insert(simulation_.states.end(), {angle(t), 0.0});
    for (const double t : events) simulation_.events.push_back({"event", t, {}});
    const EventRows event_rows(grid_.t, simulation_);
    const ComputedMotion motion{dynamics_, request_, grid_, event_rows, simulation_, {}, false};
    ErrorGrowth growth(motion, {wanted, wanted});
    const std::vector<double>& t = event_rows.instants();
    goes_on = true;
    for (rows = 1; rows < t.size() && goes_on; ++rows)  // a run begins with the first
      goes_on = growth.add(rows, std::vector{angle(t[rows]) + error(t[rows]), 0.0});
    expected = growth.expected();
    at_end = safety * error(span) / wanted;
  }

  bool goes_on{};
  std::size_t rows{};         ///< that were looked at
  double expected{}, at_end;  ///< errors at the end, in units of what is wanted

 private:
  static constexpr double safety = 2;  ///< times the difference is the error
  static double angle(double t) { return std::sin(t); }

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

TEST(ErrorGrowth, RowsAtEventsAreNotThoseOfTheGrid) {
  const auto drifting = [](double t) { return 1e-3 * std::pow(t / span, 2); };
  const Growing without(drifting), with(drifting, {0.1, 3.3, 17.5, 17.6});
  EXPECT_EQ(with.rows, without.rows + 3);
  EXPECT_EQ(with.expected, without.expected);
}

TEST(ErrorGrowth, NothingIsExpectedFromTheFirstMoments) {
  const Growing early([](double t) { return t == 0.25 ? 1.0 : 1e-8; });
  EXPECT_FALSE(early.goes_on);
  EXPECT_GT(early.rows, 50U);
}

}  // namespace
}  // namespace qdot
