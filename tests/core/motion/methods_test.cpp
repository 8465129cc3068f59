// Independent methods follow the same motions, and tighter tolerances follow them more closely.

#include <gtest/gtest.h>

#include "tests/support/motions.hpp"
#include "tests/support/system_test.hpp"

namespace qdot {
namespace {

/// A method bounds the error of a step by rtol; a run adds up as many as it has steps, and the system
/// multiplies them. In the two seconds watched here, on these systems, that is less than this many times
/// rtol.
constexpr double run_over_step = 1e5;

std::string_view name(Method method) { return record_of(method).name; }

class Methods : public test::SystemTest {
 protected:
  [[nodiscard]] Simulation motion(Method method, Tolerances tolerances) const {
    SimulationRequest request = test::request_for(model(), {}, test::instants(2, 20));
    request.method = method;
    request.tolerances = tolerances;
    return simulate(dynamics_, request);
  }

 private:
  Dynamics dynamics_{test::model_of(GetParam())};
};
INSTANTIATE_TEST_SUITE_P(Systems, Methods, testing::ValuesIn(test::all_systems()), test::system_name);

TEST_P(Methods, AgreeOnTheMotion) {
  const Simulation best = motion(test::best_method, test::best_tolerances);
  ASSERT_EQ(best.rows, 21u);
  for (const Method method : test::all_methods) {
    constexpr double rtol = 1e-9;
    EXPECT_LT(test::difference(motion(method, {rtol, rtol / 100}), best), run_over_step * rtol)
        << name(method);
  }
}

TEST_P(Methods, ComeNearerWithATighterTolerance) {
  const Simulation best = motion(test::best_method, test::best_tolerances);
  constexpr double round_off = 1e-11;  // where a motion is exact up to this, it cannot come nearer
  constexpr double at_least = 3;       // a hundred times would be ideal; orders and steps change in jumps
  for (const Method method : test::all_methods) {
    const double coarse = test::difference(motion(method, {1e-5, 1e-7}), best);
    const double fine = test::difference(motion(method, {1e-7, 1e-9}), best);
    EXPECT_LE(fine, std::max(coarse / at_least, round_off)) << name(method);
  }
}

}  // namespace
}  // namespace qdot
