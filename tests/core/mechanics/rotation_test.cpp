// Turns one after the other: where they bring the body's axes, and the angular velocity that follows.

#include "core/mechanics/rotation.hpp"

#include <gtest/gtest.h>

#include <string>
#include <tuple>

#include "core/expr/print/print.hpp"
#include "core/expr/simplify.hpp"

namespace qdot {
namespace {

struct EulerAngles {
  Graph graph;
  std::vector<Expression> angles, rates;
  std::vector<Replacement> pairs;
  std::vector<Turn> turns;

  EulerAngles() {
    for (const char* name : {"phi", "theta", "psi"}) {
      angles.push_back(graph.symbol(name));
      rates.push_back(graph.symbol(std::string(name) + "_dot"));
      pairs.emplace_back(angles.back(), rates.back());
    }
    for (std::size_t k = 0; k < 3; ++k) turns.push_back({axis(k == 1 ? 0 : 2), angles[k]});
  }
  Vector axis(std::size_t k) {
    Vector v(3, graph.number(0));
    v[k] = graph.number(1);
    return v;
  }
};

std::vector<std::string> texts(const Vector& v) {
  std::vector<std::string> result;
  for (const Expression& e : v) result.push_back(print(simplify(e), Form::text));
  return result;
}

TEST(Rotation, OfEulersAnglesPointsTheThirdAxisAsGoldsteinHasIt) {
  EulerAngles euler;
  EXPECT_EQ(texts(turned(euler.turns, euler.axis(2))),
            (std::vector<std::string>{"sin(phi)*sin(theta)", "-sin(theta)*cos(phi)", "cos(theta)"}));
}

TEST(Rotation, HasGoldsteinsAngularVelocityInTheBody) {
  EulerAngles euler;
  const Vector omega = body_angular_velocity(euler.graph, euler.turns, euler.pairs);
  const auto& [phi, theta, psi] = std::tie(euler.rates[0], euler.rates[1], euler.rates[2]);
  const Expression &b = euler.angles[1], &c = euler.angles[2];
  const Vector known{phi * sin(b) * sin(c) + theta * cos(c), phi * sin(b) * cos(c) - theta * sin(c),
                     phi * cos(b) + psi};
  for (std::size_t k = 0; k < 3; ++k) EXPECT_TRUE(simplify(omega[k] - known[k]).is_zero()) << k;
}

TEST(Rotation, HasOneAngularVelocityInSpaceAndInTheBody) {
  EulerAngles euler;
  const Vector in_body = body_angular_velocity(euler.graph, euler.turns, euler.pairs);
  const Vector in_space = space_angular_velocity(euler.graph, euler.turns, euler.pairs);
  const Vector turned_back = turned(euler.turns, in_body);
  for (std::size_t k = 0; k < 3; ++k) EXPECT_TRUE(simplify(turned_back[k] - in_space[k]).is_zero()) << k;
}

TEST(Rotation, SequencesInSmallLettersAreTheOppositeOrder) {
  EXPECT_EQ(turn_sequence("ZYX")->axes, (std::vector<std::size_t>{2, 1, 0}));
  EXPECT_FALSE(turn_sequence("ZYX")->backwards);
  EXPECT_EQ(turn_sequence("xyz")->axes, (std::vector<std::size_t>{2, 1, 0}));
  EXPECT_TRUE(turn_sequence("xyz")->backwards);
  for (const char* wrong : {"ZyX", "ABC", "Z X"}) EXPECT_FALSE(turn_sequence(wrong)) << wrong;
}

}  // namespace
}  // namespace qdot
