// What every method of a fixed step promises, whichever there are: the order that its summary states, the
// same steps whatever is asked of them, and an end where it cannot go on.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <regex>
#include <stdexcept>
#include <string>
#include <vector>

#include "core/integrate/integrate.hpp"
#include "core/integrate/methods.hpp"
#include "tests/core/integrate/systems.hpp"

namespace qdot {
namespace {

using namespace integrate_test;

class FixedSteps : public testing::TestWithParam<Method> {
 protected:
  [[nodiscard]] static RunRequest request_with(double h, double t_end) {
    return {.y_start = {2, 0}, .t_end = t_end, .method = GetParam(), .h = h};
  }

  /// "of order 6" in the words that users read.
  [[nodiscard]] static double stated_order() {
    const std::string summary(record_of(GetParam()).summary);
    std::smatch found;
    EXPECT_TRUE(std::regex_search(summary, found, std::regex(R"(\border (\d+)\b)"))) << summary;
    return found.empty() ? 0 : std::stod(found[1]);
  }

  /// log2(error(h) / error(h / 2)), in the limit of short steps: as h is halved until the error is so small
  /// that round-off would soon show. Expects the steps before the last to come near it too.
  template <class Error>
  static void expect_stated_order(Error error) {
    constexpr double small = 1e-10;
    double h = 0.25, coarse = error(h), order = 0;
    while (coarse > small && h > 1e-3) {
      const double fine = error(h /= 2);
      order = std::log2(coarse / fine);
      EXPECT_NEAR(order, stated_order(), 0.3) << h;
      coarse = fine;
    }
    EXPECT_NEAR(order, stated_order(), 0.1);
  }
};
INSTANTIATE_TEST_SUITE_P(Methods, FixedSteps, testing::ValuesIn(methods_of_fixed_step),
                         [](const auto& given) { return std::string(name(given.param)); });

TEST_P(FixedSteps, HaveTheStatedOrderAsTheStepIsHalved) {
  expect_stated_order([](double h) {
    const auto run = integrated(pendulum(), request_with(h, 8));
    const auto exact = released_pendulum(8, 2);
    return std::max(std::abs(run.y[0] - exact[0]), std::abs(run.y[1] - exact[1]));
  });
}

TEST_P(FixedSteps, HaveTheStatedOrderBetweenTheirEnds) {
  expect_stated_order([](double h) {
    const std::vector<double> grid = equal_grid(0, 8, 97);
    RunRequest request = request_with(h, 8);
    request.grid = grid;
    return largest_error(integrated(pendulum(), request), grid,
                         [](double t) { return released_pendulum(t, 2); });
  });
}

TEST_P(FixedSteps, AreThoseOfAShorterRunAndTheLastOneEndsAtTheEnd) {
  const RightHandSide system = pendulum();
  const auto times = [&](double h, double t_end) {
    const RunRequest request = request_with(h, t_end);
    const auto stepper = make_stepper(system, request);
    std::vector<double> t;
    while (stepper->t() < t_end && !stepper->step()) t.push_back(stepper->t());
    return t;
  };
  EXPECT_EQ(times(0.3, 1), (std::vector<double>{0.3, 0.6, 0.3 * 3, 1}));
  EXPECT_EQ(times(0.1, 0.7).size(), 7u);  // 7 * 0.1 > 0.7, by round-off only
  EXPECT_EQ(times(0.1, 0.7).back(), 0.7);
  EXPECT_EQ(times(5, 1), std::vector<double>{1});
  const auto shorter = integrated(system, request_with(0.3, 0.6));
  RunRequest longer = request_with(0.3, 1);
  const std::vector<double> grid{0.6};
  longer.grid = grid;
  EXPECT_EQ(integrated(system, longer).states, shorter.y);
}

TEST_P(FixedSteps, AreNotChangedByRows) {
  RunRequest request = request_with(0.25, 10);
  const auto alone = integrated(pendulum(), request);
  const std::vector<double> grid = equal_grid(0, 10, 333);
  request.grid = grid;
  const auto sampled = integrated(pendulum(), request);
  EXPECT_EQ(sampled.y, alone.y);
  EXPECT_EQ(sampled.steps, alone.steps);
}

TEST_P(FixedSteps, HaveTheirEventsFoundWithinThem) {
  RunRequest request = request_with(0.01, 3);
  request.events = {{.value = [](double, auto y) { return y[0]; }, .direction = Crossing::falling}};
  const auto run = integrated(pendulum(), request);
  ASSERT_FALSE(run.events.empty());
  const double at_most = 100 * std::pow(0.01, stated_order());
  EXPECT_NEAR(run.events[0].t, quarter_period(2), std::max(at_most, 1e-12));
}

TEST_P(FixedSteps, OfALengthThatMeansNothingAreRefused) {
  EXPECT_THROW((void)integrated(pendulum(), request_with(0, 1)), std::invalid_argument);
  EXPECT_THROW((void)integrated(pendulum(), request_with(-1, 1)), std::invalid_argument);
}

TEST_P(FixedSteps, AndEvaluationsAreBounded) {
  RunRequest request = request_with(0.01, 10);
  request.limits.max_steps = 10;
  auto run = integrated(pendulum(), request);
  EXPECT_EQ(run.ending, Ending::step_limit);
  EXPECT_EQ(run.steps, 10u);
  request.limits = {};
  request.limits.max_evaluations = 100;
  run = integrated(pendulum(), request);
  EXPECT_EQ(run.ending, Ending::step_limit);
  EXPECT_LE(run.evaluations, 100u);
}

}  // namespace
}  // namespace qdot
