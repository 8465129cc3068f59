#pragma once
// Random expressions for laws such as parse(print(e)) == e.

#include <array>
#include <span>
#include <string>
#include <vector>

#include "core/expr/expression.hpp"
#include "tests/support/random.hpp"

namespace qdot::test {

/// What random expressions are made of.
struct Ingredients {
  std::vector<std::string> symbols{"m", "g", "l", "theta", "phi", "theta_dot", "phi_ddot"};
  std::vector<Function> functions{Function::sin,  Function::cos,  Function::tan,  Function::asin,
                                  Function::acos, Function::atan, Function::sinh, Function::cosh,
                                  Function::tanh, Function::exp,  Function::log,  Function::abs,
                                  Function::sign};
  bool doubles{true};            ///< inexact numbers too
  bool powers_of_numbers{true};  ///< sqrt(5/4) too
};

inline Number random_number(Random& random, bool doubles) {
  switch (random.integer(0, doubles ? 5 : 3)) {
    case 0:
      return Number(random.integer(1, 9));
    case 1:
      return -Number(random.integer(1, 3));
    case 2:
      return Number::ratio(random.integer(-20, 20) | 1, random.integer(1, 12));
    case 3:
      return Number::ratio(random.integer(1, 99999), 1000);
    case 4:
      return Number::real(random.real(-10, 10));
    default:
      return Number::real(random.real() *
                          power(Number(10), static_cast<int>(random.integer(-30, 30))).value());
  }
}

inline Expression random_expression(Random& random, Graph& graph, int depth,
                                    const Ingredients& ingredients = {}) {
  const auto pick = [&](const auto& list) {
    return list[static_cast<std::size_t>(random.integer(0, static_cast<std::int64_t>(list.size()) - 1))];
  };
  const auto part = [&] { return random_expression(random, graph, depth - 1, ingredients); };
  const auto parts = [&] {
    std::vector<Expression> list;
    for (auto i = random.integer(2, 4); i > 0; --i) list.push_back(part());
    return list;
  };
  if (depth == 0 || random.integer(0, 9) == 0) {
    const bool symbol = random.integer(0, 3) > 0;
    return symbol ? graph.symbol(pick(ingredients.symbols))
                  : graph.number(random_number(random, ingredients.doubles));
  }
  switch (random.integer(0, 5)) {
    case 0:
    case 1:
      return graph.sum(parts());
    case 2:
    case 3:
      return graph.product(parts());
    case 4: {
      constexpr std::array<std::array<int, 2>, 8> exponents{
          {{2, 1}, {3, 1}, {-1, 1}, {-2, 1}, {1, 2}, {-1, 2}, {3, 2}, {-1, 3}}};
      const auto [p, q] = pick(exponents);
      const Expression base = part();
      const bool kept = base.is_zero() || (base.number() != nullptr && !ingredients.powers_of_numbers);
      return kept ? base : pow(base, Number::ratio(p, q));
    }
    default:
      return graph.call(pick(ingredients.functions), part());
  }
}

}  // namespace qdot::test
