#include "core/integrate/prince_dormand.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <map>
#include <vector>

#include "tests/core/integrate/systems.hpp"

namespace qdot {
namespace {

using namespace integrate_test;

/// A rooted tree is the list of its root's subtrees. Source: Hairer, Norsett, Wanner, Solving Ordinary
/// Differential Equations I, II.2: order q <=> sum_i b_i phi_i(tree) = 1 / gamma(tree) for all trees of at
/// most q nodes.
struct Tree {
  std::vector<Tree> subtrees;
};

int nodes(const Tree& tree) {
  int count = 1;
  for (const Tree& subtree : tree.subtrees) count += nodes(subtree);
  return count;
}

double gamma(const Tree& tree) {
  double product = nodes(tree);
  for (const Tree& subtree : tree.subtrees) product *= gamma(subtree);
  return product;
}

using Stages = std::array<double, PrinceDormand::stages>;

Stages phi(const Tree& tree) {
  Stages product;
  product.fill(1);
  for (const Tree& subtree : tree.subtrees) {
    const Stages inner = phi(subtree);
    for (std::size_t i = 0; i < product.size(); ++i) {
      double sum = 0;
      for (std::size_t j = 0; j < i; ++j) sum += PrinceDormand::a[i][j] * inner[j];
      product[i] *= sum;
    }
  }
  return product;
}

/// All trees of n nodes: subtrees in non-increasing order of (size, place in the list of that size).
const std::vector<Tree>& trees(int n) {
  static std::map<int, std::vector<Tree>> known;
  if (const auto found = known.find(n); found != known.end()) return found->second;
  std::vector<Tree> all;
  Tree tree;
  std::function<void(int, int, std::size_t)> extend = [&](int left, int size, std::size_t last) {
    if (left == 0) return all.push_back(tree);
    for (int s = std::min(size, left); s > 0; --s) {
      const auto& choices = trees(s);
      for (std::size_t i = 0; i < (s == size ? last + 1 : choices.size()) && i < choices.size(); ++i) {
        tree.subtrees.push_back(choices[i]);
        extend(left - s, s, i);
        tree.subtrees.pop_back();
      }
    }
  };
  extend(n - 1, n - 1, std::size_t(-2));
  return known[n] = all;
}

double worst_residual(const Stages& weights, int order) {
  double worst = 0;
  for (const Tree& tree : trees(order)) {
    const Stages stage = phi(tree);
    double sum = 0;
    for (std::size_t i = 0; i < stage.size(); ++i) sum += weights[i] * stage[i];
    worst = std::max(worst, std::abs(sum * gamma(tree) - 1));
  }
  return worst;
}

constexpr double round_off = 1e-13;  // of sums with weights up to 17

TEST(PrinceDormand, AllOrderConditionsHoldUpToEightAndSeven) {
  const std::array<std::size_t, 8> count{1, 1, 2, 4, 9, 20, 48, 115};
  for (int order = 1; order <= 8; ++order) {
    EXPECT_EQ(trees(order).size(), count[order - 1]);
    EXPECT_LT(worst_residual(PrinceDormand::b, order), round_off) << order;
  }
  for (int order = 1; order <= 7; ++order)
    EXPECT_LT(worst_residual(PrinceDormand::d, order), round_off) << order;
  EXPECT_GT(worst_residual(PrinceDormand::d, 8), 1e-3);  // or there would be no error estimate
}

TEST(PrinceDormand, NodesAreTheRowSums) {
  for (std::size_t i = 0; i < PrinceDormand::stages; ++i) {
    double sum = 0;
    for (const double weight : PrinceDormand::a[i]) sum += weight;
    EXPECT_NEAR(sum, PrinceDormand::c[i], round_off);
  }
}

TEST(PrinceDormand, ErrorEstimateSeesAForceThatDependsOnTimeOnly) {
  // Fehlberg's does not (see the header). For y' = t^k, k = 7 is the first power on which the two weights may
  // differ.
  double estimate = 0;
  for (std::size_t i = 0; i < PrinceDormand::stages; ++i)
    estimate += (PrinceDormand::b[i] - PrinceDormand::d[i]) * std::pow(PrinceDormand::c[i], 7);
  EXPECT_GT(std::abs(estimate), 1e-6);
}

// Error of one step of length h from the pendulum's turning point.
double error_of_step(double h) {
  const RightHandSide system = pendulum();
  const Limits limits;
  Evaluator evaluator(system, limits);
  RungeKuttaFan fan(evaluator, 2);
  fan.set_base(0, std::vector<double>{2, 0});
  std::vector<double> y(2);
  EXPECT_EQ(fan.advance(h, y), answer_ok);
  const auto exact = released_pendulum(h, 2);
  return std::max(std::abs(y[0] - exact[0]), std::abs(y[1] - exact[1]));
}

TEST(RungeKuttaFan, DenseOutputHasTheLocalErrorOfOrderNine) {
  // Halving h divides the error of a step by 2^9 = 512 in the limit.
  const double observed = std::log2(error_of_step(1.2) / error_of_step(0.6));
  EXPECT_GT(observed, 8.5);
}

TEST(RungeKuttaFan, SharesTheFirstStageAmongTheSamplesOfAStep) {
  const RightHandSide system = pendulum();
  const Limits limits;
  Evaluator evaluator(system, limits);
  RungeKuttaFan fan(evaluator, 2);
  fan.set_base(0, std::vector<double>{2, 0});
  std::vector<double> y(2);
  for (const double h : {0.1, 0.2, 0.3}) EXPECT_EQ(fan.advance(h, y), answer_ok);
  EXPECT_EQ(evaluator.evaluations(), 13u + 12u + 12u);
  fan.set_base(0.3, y);
  EXPECT_EQ(fan.advance(0.1, y), answer_ok);
  EXPECT_EQ(evaluator.evaluations(), 13u + 12u + 12u + 13u);
}

}  // namespace
}  // namespace qdot
