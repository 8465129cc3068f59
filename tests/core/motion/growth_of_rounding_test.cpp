// Computations that begin an ulp apart.

#include "core/motion/growth_of_rounding.hpp"

#include <gtest/gtest.h>

#include "core/dynamics/dynamics.hpp"
#include "tests/support/motions.hpp"

namespace qdot {
namespace {

using namespace test;

/// From 0 to t_end, of a mass under a force, as a reference of that tolerance.
class MassUnder {
 public:
  MassUnder(const std::string& force, double x, double t_end) : dynamics_(mass_under(force)) {
    request_ = request_for(dynamics_.model(), {{"x", x}}, instants(t_end, 10));
    request_.method = Method::taylor;
    request_.taylor_order = 22;
    request_.tolerances = {1e-14, 1e-17};
    request_.is_reference = request_.keeps_steps = true;
    simulation_ = simulate(dynamics_, request_);
  }

  std::vector<double> growth(double dx, double dL = 0) const {
    std::vector<double> moved = request_.parameters;
    for (std::size_t i = 0; i < moved.size(); ++i) {
      if (dynamics_.model().scene.parameters[i].name == "L") moved[i] += dL;
    }
    return growth_of_rounding(dynamics_.accelerations(), {.parameters = request_.parameters,
                                                          .moved_parameters = moved,
                                                          .moved_by = {dx, 0},
                                                          .steps = simulation_.step_ends,
                                                          .t_start = 0,
                                                          .y_start = request_.y_start});
  }

 private:
  Dynamics dynamics_;
  SimulationRequest request_;
  Simulation simulation_;
};

TEST(GrowthOfRounding, IsThatOfTheMotion) {
  const MassUnder pushed("x*F/L", 1, 12);
  const auto growth = pushed.growth(1e-9);
  EXPECT_NEAR(growth[0], 1e-9 * std::cosh(12), 1e-3 * growth[0]);
  EXPECT_NEAR(growth[1], 1e-9 * std::sinh(12), 1e-3 * growth[1]);
}

TEST(GrowthOfRounding, OfAnOscillationDoesNotGrow) {
  const MassUnder pulled("-x*F/L", 1, 100);
  EXPECT_NEAR(pulled.growth(1e-9)[0], 1e-9, 1e-11);
}

TEST(GrowthOfRounding, IsLargeWhereParametersCancel) {
  const MassUnder smooth("-sin(x/L)*F", 0.5, 3), cancelling("-(1e6*(F - m*L/T^2) + sin(x/L)*F)", 0.5, 3);
  EXPECT_LT(smooth.growth(0, 0x1p-52)[1], 1e-15);
  EXPECT_GT(cancelling.growth(0, 0x1p-52)[1], 1e-10);
}

/// An ulp of x is lost in y + e where y is large, and both computations would be the same.
TEST(GrowthOfRounding, IsSeenWhereItIsLessThanAnUlp) {
  const MassUnder moving("x*F/L", 1, 3);
  EXPECT_GT(moving.growth(0x1p-60)[0], 0x1p-53);
}

}  // namespace
}  // namespace qdot
