#include "core/steady/comparable_units.hpp"

#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace qdot {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

/// A pendulum in its place x, y with the multiplier of x^2 + y^2 - l^2, m = 2 kg, l = 0.1 m, g = 10 m/s^2,
/// pushed aside by 1 N.
PlaceWithForces pendulum() {
  PlaceWithForces place{VectorXd(3), VectorXd(3), MatrixXd::Zero(3, 3), MatrixXd::Zero(3, 3), {}};
  place.x << 0, -0.1, -100;
  place.forces << -1, 0, 0;
  place.stiffness << 200, 0, 0, 0, 200, 0.2, 0, 0.2, 0;
  place.inertia.diagonal() << 2, 2, 0;
  place.stiffness_at = [](const VectorXd&) { return std::nullopt; };
  return place;
}

/// The same with each coordinate in another unit: x_i = units_i x_i'.
PlaceWithForces in(const VectorXd& units, const PlaceWithForces& place) {
  const auto u = units.asDiagonal();
  return {place.x.cwiseQuotient(units), u * place.forces, u * place.stiffness * u, u * place.inertia * u,
          place.stiffness_at};
}

TEST(ComparableUnits, AMultiplierIsMeasuredByWhatItDoes) {
  const PlaceWithForces place = pendulum();
  const VectorXd units = comparable_units(place.stiffness, place.inertia);
  const MatrixXd scaled = units.asDiagonal() * place.stiffness * units.asDiagonal();
  EXPECT_DOUBLE_EQ(scaled(0, 0), 100);
  EXPECT_DOUBLE_EQ(scaled(1, 2), 100);
}

TEST(ComparableUnits, StiffnessAndSizesAreTheSameInAnyUnits) {
  for (const double z : {0.0, -0.1}) {
    PlaceWithForces place = pendulum();
    place.x[1] = z;
    const std::vector<std::string> no_angles(3);
    const VectorXd units = comparable_units(place.stiffness, place.inertia),
                   sizes = sizes_at(place, no_angles);
    const MatrixXd scaled = units.asDiagonal() * place.stiffness * units.asDiagonal();
    for (const double length : {1e-40, 1e-12, 1e12}) {
      for (const double multiplier : {1e-60, 1e-3, 1e20}) {
        const VectorXd other = VectorXd{{length, length, multiplier}};
        const PlaceWithForces there = in(other, place);
        const VectorXd own = comparable_units(there.stiffness, there.inertia);
        const MatrixXd own_scaled = own.asDiagonal() * there.stiffness * own.asDiagonal();
        EXPECT_TRUE(own_scaled.isApprox(scaled, 1e-14)) << own_scaled;
        EXPECT_TRUE(sizes_at(there, no_angles).cwiseProduct(other).isApprox(sizes, 1e-14)) << length;
      }
    }
  }
}

TEST(ComparableUnits, WhereAllIsZeroTheForcesSayWhatIsLarge) {
  PlaceWithForces place = pendulum();
  EXPECT_DOUBLE_EQ(sizes_at(place, {"m", "m", "N/m"})[0], 0.1);
  place.x.setZero();
  const double reach = 1 / place.stiffness(0, 0);
  EXPECT_DOUBLE_EQ(sizes_at(place, {"m", "m", "N/m"})[0], reach);
  EXPECT_DOUBLE_EQ(sizes_at(place, {"m", "m", "N/m"})[1], reach);
  place.stiffness_at = [k = place.stiffness](const VectorXd&) { return 4 * k; };
  EXPECT_DOUBLE_EQ(sizes_at(place, {"m", "m", "N/m"})[0], reach / 4);
  place.forces.setZero();
  EXPECT_EQ(sizes_at(place, {"m", "m", "N/m"}), VectorXd::Ones(3));
  EXPECT_EQ(sizes_at(place, {"rad", "m", "N/m"})[0], 1);
}

}  // namespace
}  // namespace qdot
