// The trade of error against work: points that can be believed, and the front that follows from them.

#include "core/motion/work_precision.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "tests/support/motions.hpp"
#include "tests/support/system_test.hpp"

namespace qdot::work_precision_test {
namespace {

using ::testing::ElementsAre;

TrialResult result(double error, std::uint64_t evaluations) {
  return {{Method::taylor, {}, {}}, Ending::reached_end, {error}, error, evaluations, 1};
}

TrialResult failure() { return {{}, Ending::step_limit, {}, 0, 1, 1}; }

std::vector<double> costs_of(std::span<const TrialResult> trials) {
  std::vector<double> costs;
  for (const TrialResult& trial : trials) costs.push_back(static_cast<double>(trial.evaluations));
  return costs;
}

TEST(WorkPrecision, FrontIsWhatNothingBeats) {
  const std::vector<TrialResult> trials{result(1e-3, 100), result(1e-6, 200), result(1e-5, 300),
                                        result(1e-6, 250), result(1e-9, 900), result(1e-9, 900),
                                        failure()};
  EXPECT_THAT(pareto_front(trials, costs_of(trials)),
              ElementsAre(true, true, false, false, true, true, false));
}

TEST(WorkPrecision, RecommendsTheCheapestThatReachesTheError) {
  const std::vector<TrialResult> trials{result(1e-3, 100), result(1e-6, 200), result(1e-8, 150), failure()};
  const std::vector<double> costs = costs_of(trials);
  EXPECT_EQ(cheapest(trials, costs, 1e-2), 0U);
  EXPECT_EQ(cheapest(trials, costs, 1e-6), 2U);
  EXPECT_EQ(cheapest(trials, costs, 1e-9), std::nullopt);
}

/// x = x0 cos(w t): the isotropic oscillator that the spring pendulum is for l0 = 0, g = 0.
const Values oscillator{{"m", 0.5},  {"k", 8},     {"l0", 0},       {"g", 0},
                        {"l", 1.25}, {"theta", 0}, {"theta_dot", 2}};

double exact_length(double t) { return std::hypot(1.25 * std::cos(4 * t), 0.625 * std::sin(4 * t)); }

class OscillatorStudy : public ::testing::Test {
 protected:
  OscillatorStudy() : model_(test::model_of("spring_pendulum")), dynamics_(model_) {
    request_ = test::request_for(*model_, oscillator, test::instants(5, 20));
  }

  std::shared_ptr<const Model> model_;
  Dynamics dynamics_;
  SimulationRequest request_;
};

TEST_F(OscillatorStudy, EveryPointsErrorHoldsAgainstTheClosedForm) {
  WorkPrecision study(dynamics_, request_);
  EXPECT_LT(study.reference().max_abs_error[0], 1e-12);
  for (const Method method : test::all_methods) {
    for (const Trial& trial : study.trials(method)) {
      const TrialResult found = study.run(trial);
      if (found.ending == Ending::step_limit) {
        EXPECT_GE(found.evaluations, 4 * study.reference().simulation.evaluations);
        continue;
      }
      ASSERT_EQ(found.max_abs_error.size(), 4U);
      SimulationRequest again = request_;
      again.method = trial.method;
      again.tolerances = trial.tolerances;
      const Simulation motion = simulate(dynamics_, again);
      double error = 0;
      for (std::size_t i = 0; i < motion.rows; ++i) {
        error = std::max(error, std::abs(test::row(motion, i)[0] - exact_length(request_.grid[i])));
      }
      EXPECT_LE(error, found.max_abs_error[0]) << static_cast<int>(method) << " " << trial.tolerances.rtol;
      EXPECT_LE(found.max_abs_error[0], error + 2 * study.reference().max_abs_error[0] + 1e-14);
      EXPECT_EQ(found.evaluations, motion.evaluations);
    }
  }
}

TEST_F(OscillatorStudy, ErrorFollowsToleranceOverEightDecades) {
  WorkPrecision study(dynamics_, request_);
  for (const Method method : test::all_methods) {
    const std::vector<Trial> trials = study.trials(method);
    const TrialResult loose = study.run(trials[0]), tight = study.run(trials[8]);  // 1e-3 and 1e-11
    ASSERT_FALSE(tight.max_abs_error.empty()) << static_cast<int>(method);
    EXPECT_LT(tight.error, 1e-6 * loose.error) << static_cast<int>(method);
    EXPECT_GT(tight.evaluations, loose.evaluations);
  }
}

TEST_F(OscillatorStudy, WorkIsBounded) {
  request_.limits.max_evaluations = 30'000;
  WorkPrecision study(dynamics_, request_);
  ASSERT_FALSE(study.reference().max_abs_error.empty());
  std::uint64_t spent = 0;
  bool broken_off = false;
  for (const Method method : test::all_methods) {
    for (const Trial& trial : study.trials(method)) {
      const TrialResult found = study.run(trial);
      spent += found.evaluations;
      broken_off = broken_off || (found.ending == Ending::step_limit && found.max_abs_error.empty());
    }
  }
  EXPECT_LE(spent, 30'000U);
  EXPECT_TRUE(broken_off);
}

}  // namespace
}  // namespace qdot::work_precision_test
