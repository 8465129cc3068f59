// Following curves whose points are known: a circle, which has folds, and a straight line that ends.

#include "core/numerics/path_following.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

namespace qdot {
namespace {

using Eigen::Vector2d;
using Eigen::VectorXd;

/// x^2 + y^2 = 1, given up below `lowest`.
struct Circle {
  using Place = Vector2d;
  struct Linearization {
    Eigen::MatrixXd derivative;
    VectorXd residual;
  };
  double lowest{-2};

  [[nodiscard]] std::optional<Linearization> linearized(const Place& p) const {
    return Linearization{2 * p.transpose(), VectorXd::Constant(1, p.squaredNorm() - 1)};
  }
  [[nodiscard]] std::optional<Place> moved(const Place& p, const VectorXd& step) const {
    const Place to = p + step;
    return to.y() >= lowest ? std::optional(to) : std::nullopt;
  }
};

constexpr Corrections corrections{.most = 8, .accuracy = 1e-12};
constexpr Advances advances{
    .first = 0.1, .least = 1e-3, .largest = 0.2, .least_cosine = 0.9, .most_points = 1000};

std::vector<Vector2d> points_of(Circle circle, const Vector2d& start, const Vector2d& direction) {
  const auto first = corrected(circle, start, direction, corrections);
  if (!first) return {};
  std::vector<Vector2d> points{first->at};
  double turned = 0;
  const auto visit = [&](const auto& last, const auto& next, double) {
    points.push_back(next.at);
    turned += std::acos(std::min(1.0, last.tangent.dot(next.tangent)));
    return turned < 2 * std::numbers::pi;
  };
  follow_curve(
      circle, *first, corrections, advances, [](const auto&) { return true; }, visit);
  return points;
}

TEST(PathFollowing, GoesAllAroundACircleThroughItsFolds) {
  const auto points = points_of({}, {1.1, 0}, {0, 1});
  ASSERT_GT(points.size(), 30u);
  bool left = false, below = false;
  for (const Vector2d& p : points) {
    EXPECT_NEAR(p.norm(), 1, 1e-12);
    left = left || p.x() < -0.95;
    below = below || p.y() < -0.95;
  }
  EXPECT_TRUE(left && below);
}

TEST(PathFollowing, StartsInTheDirectionThatIsGiven) {
  EXPECT_GT(points_of({}, {1, 0}, {0, 1})[1].y(), 0);
  EXPECT_LT(points_of({}, {1, 0}, {0, -1})[1].y(), 0);
}

TEST(PathFollowing, EndsWhereTheCurveIsLeft) {
  for (const Vector2d& p : points_of({.lowest = -0.5}, {1, 0}, {0, -1})) EXPECT_GE(p.y(), -0.5);
}

TEST(PathFollowing, HasNoPointWhereNewtonsMethodFindsNone) {
  Circle circle;
  EXPECT_FALSE(corrected(circle, Vector2d(0, 5), Vector2d(0, 1), corrections));  // x = 0 is as far as it gets
}

TEST(DistanceToPiece, IsThatOfTheNearestPointBetweenTheEnds) {
  const auto distance = [](double a_x, double a_y, double b_x, double b_y) {
    return distance_to_piece(Vector2d(a_x, a_y), Vector2d(b_x, b_y));
  };
  EXPECT_DOUBLE_EQ(distance(-1, 2, 3, 2), 2);  // beside the piece
  EXPECT_DOUBLE_EQ(distance(3, 4, 6, 8), 5);   // before its beginning
  EXPECT_DOUBLE_EQ(distance(6, 8, 3, 4), 5);   // past its end
}

}  // namespace
}  // namespace qdot
