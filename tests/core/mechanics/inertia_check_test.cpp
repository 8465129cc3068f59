// Mass matrices that are singular by an identity, of one size and another, and those that are not.

#include "core/mechanics/inertia_check.hpp"

#include <gtest/gtest.h>

#include "core/expr/calculus.hpp"
#include "core/expr/parse.hpp"

namespace qdot {
namespace {

class InertiaOf : public testing::Test {
 protected:
  /// d2L/dv_i dv_j for velocities v0, v1, ...
  Matrix mass_matrix(const std::string& lagrangian, std::size_t n) {
    const std::vector<std::string> names{"v0", "v1", "v2", "v3", "v4", "m", "q0", "q1"};
    const Expression l = parse(lagrangian, graph_, names);
    Matrix matrix(n);
    for (std::size_t i = 0; i < n; ++i) {
      for (std::size_t j = 0; j < n; ++j)
        matrix[i].push_back(
            differentiate(differentiate(l, graph_.symbol(names[i])), graph_.symbol(names[j])));
    }
    return matrix;
  }

  Graph graph_;
};

TEST_F(InertiaOf, AHomogeneousLagrangianIsSingularInEveryState) {
  for (std::size_t n = 1; n <= 5; ++n) {
    std::string squares = "v0^2";
    for (std::size_t i = 1; i < n; ++i) squares += " + v" + std::to_string(i) + "^2";
    EXPECT_TRUE(inertia_fault(mass_matrix("m*sqrt(" + squares + ")", n))) << n;
    EXPECT_FALSE(inertia_fault(mass_matrix("m*(" + squares + ")/2", n))) << n;
    EXPECT_FALSE(inertia_fault(mass_matrix("-m*sqrt(9 - " + squares + ")", n))) << n;
  }
}

TEST_F(InertiaOf, ALagrangianThatHasNoValueInMostStatesIsLookedAtWhereItHas) {
  for (const char* l : {"-m*sqrt(v0^2 - v1^2)", "-m*sqrt(v1^2 - v0^2)", "sqrt(1 - q0)*sqrt(v0^2 - v1^2)",
                        "(v0^3 + v1^3)^(1/3)", "-m*sqrt(v0^2 - v1^2) - m*sqrt(4*v0^2 - v1^2) - q0*v0",
                        "-m*sqrt(v0^2 - 4*v1^2)"})
    EXPECT_TRUE(inertia_fault(mass_matrix(l, 2))) << l;
  EXPECT_FALSE(inertia_fault(mass_matrix("-m*sqrt(1 - v0^2 - v1^2)", 2)));
  EXPECT_FALSE(inertia_fault(mass_matrix("-m*sqrt(v0^2 - v1^2 - q1)", 2)));
}

TEST_F(InertiaOf, AnIdentityOfAnglesIsSeen) {
  EXPECT_TRUE(inertia_fault(mass_matrix("m*(v0*cos(q0) + v1*sin(q0))^2", 2)));
  EXPECT_FALSE(inertia_fault(mass_matrix("m*(v0*cos(q0) + v1*sin(q0))^2 + 0.001*m*v1^2", 2)));
}

TEST_F(InertiaOf, ACoordinateWithoutInertiaIsNamed) {
  const auto fault = inertia_fault(mass_matrix("m*v0^2 + m*sin(q0)^2*v2 + m*cos(q0)^2*v2", 3));
  ASSERT_TRUE(fault);
  EXPECT_EQ(fault->coordinates, (std::vector<std::size_t>{1, 2}));
  EXPECT_FALSE(inertia_fault(mass_matrix("m*(v0 + v1)^2 + m*(v0 - v1)^2", 2)));
  const auto together = inertia_fault(mass_matrix("m*(v0 + v1)^2", 2));
  ASSERT_TRUE(together);
  EXPECT_TRUE(together->coordinates.empty());
}

}  // namespace
}  // namespace qdot
