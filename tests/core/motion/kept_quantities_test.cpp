// Answers that contradict themselves: a conserved quantity that changes by more than the errors explain.

#include "core/motion/kept_quantities.hpp"

#include <gtest/gtest.h>

#include "core/motion/ladder.hpp"
#include "tests/support/motions.hpp"

namespace qdot {
namespace {

/// A motion with errors stated of each row.
struct Motion {
  explicit Motion(const std::string& system)
      : model(test::model_of(system)),
        dynamics(model),
        request(test::request_for(*model, {}, test::instants(5, 100))) {
    request.method = Method::taylor;
    motion = simulate_with_error(dynamics, request, {.kind = AccuracyGoal::Kind::absolute, .value = 1e-9});
    for (std::size_t i = 0; i < motion.simulation.rows; ++i) {
      errors.insert(errors.end(), motion.max_abs_error.begin(), motion.max_abs_error.end());
    }
  }

  [[nodiscard]] std::string changed() const {
    const std::vector<Segment> whole{{0, request.t_start, request.y_start}};
    const std::vector<double> changes = conserved_changes(dynamics, request, motion.simulation.states, whole);
    const StatedRows rows{.t_start = request.t_start,
                          .start = request.y_start,
                          .t = request.grid,
                          .states = motion.simulation.states,
                          .errors = errors,
                          .changes = changes};
    return changed_conserved_quantity(dynamics, request.parameters, rows, motion.simulation.sections);
  }

  std::shared_ptr<const Model> model;
  Dynamics dynamics;
  SimulationRequest request;
  MeasuredSimulation motion;
  std::vector<double> errors;
};

TEST(KeptQuantities, AreKeptByHonestMotions) {
  for (const char* system : {"spring_pendulum", "free_spin_pendulum", "rod_pendulum", "whirling_pendulum"}) {
    Motion motion(system);
    EXPECT_EQ(motion.motion.meets_request, true) << system;
    EXPECT_EQ(motion.changed(), "") << system;
  }
}

TEST(KeptQuantities, ShowARowThatIsFurtherOffThanStated) {
  for (const std::size_t row : {37U, 64U, 100U}) {
    Motion motion("spring_pendulum");
    motion.motion.simulation.states[row * 4 + 2] += 1e-6;
    motion.motion.simulation.states[row * 4 + 3] += 1e-6;
    EXPECT_EQ(motion.changed(), "energy") << row;
  }
}

TEST(KeptQuantities, ShowErrorsThatAreStatedTooSmall) {
  Motion motion("spring_pendulum");
  for (double& x : motion.motion.simulation.states) x *= 1 + 1e-8;
  EXPECT_EQ(motion.changed(), "energy");
  for (double& error : motion.errors) error = 1e-6;
  EXPECT_EQ(motion.changed(), "");
}

}  // namespace
}  // namespace qdot
