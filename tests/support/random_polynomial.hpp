#pragma once
// Random polynomials as mechanics makes them: in symbols, sines and cosines of angles and of their sums.

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "core/expr/calculus.hpp"
#include "core/expr/expression.hpp"
#include "tests/support/random.hpp"

namespace qdot::test {

inline constexpr std::array polynomial_symbols{"m", "l", "theta", "phi", "theta_dot"};

inline Number small_coefficient(Random& random) {
  const std::int64_t p = random.integer(1, 6) * (random.integer(0, 1) == 0 ? -1 : 1);
  return Number::ratio(p, random.integer(1, 3));
}

/// theta, phi, 2 theta, theta - phi, theta + phi, ... never 0.
inline Expression random_angle(Random& random, Graph& graph) {
  const std::int64_t a = random.integer(-2, 2), b = random.integer(-1, 1);
  return Number(a == 0 && b == 0 ? 1 : a) * graph.symbol("theta") + Number(b) * graph.symbol("phi");
}

inline Expression random_factor(Random& random, Graph& graph) {
  switch (random.integer(0, 3)) {
    case 0:
      return sin(random_angle(random, graph));
    case 1:
      return cos(random_angle(random, graph));
    default:
      return graph.symbol(polynomial_symbols[static_cast<std::size_t>(random.integer(0, 4))]);
  }
}

/// A sum of up to `terms` products of up to three factors, some of them squared.
inline Expression random_polynomial(Random& random, Graph& graph, int terms) {
  Expression sum = graph.number(0);
  for (auto i = random.integer(1, terms); i > 0; --i) {
    Expression term = graph.number(small_coefficient(random));
    for (auto k = random.integer(0, 3); k > 0; --k)
      term = term * pow(random_factor(random, graph), Number(random.integer(1, 2)));
    sum = sum + term;
  }
  return sum;
}

/// Values of order one for all its symbols.
inline std::vector<Assignment> random_values(Random& random, Graph& graph) {
  std::vector<Assignment> values;
  for (const char* symbol : polynomial_symbols) values.emplace_back(graph.symbol(symbol), random.real(-2, 2));
  return values;
}

/// The largest value of e and its parts: what round-off in e is measured by.
inline double largest_part(const Expression& e, const std::vector<Assignment>& values) {
  double largest = 0;
  const NodeId root = e.id();
  for (const NodeId id : reachable(e.graph(), {&root, 1}))
    largest = std::max(largest, std::abs(evaluate({e.graph(), id}, values)));
  return largest;
}

}  // namespace qdot::test
