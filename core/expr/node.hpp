#pragma once
// The kinds of expression: a closed set. A node names its children by their numbers in the arena
// (core/expr/expression.hpp), where children are always older than their parents.

#include <cstdint>
#include <string>
#include <variant>
#include <vector>

#include "core/expr/number.hpp"
#include "core/numerics/function.hpp"

namespace qdot {

using NodeId = std::uint32_t;

struct Literal {
  Number value;
  bool operator==(const Literal&) const = default;
};
struct Symbol {
  std::string name;
  bool operator==(const Symbol&) const = default;
};
/// Two or more terms, sorted by what stands behind their coefficient.
struct Sum {
  std::vector<NodeId> terms;
  bool operator==(const Sum&) const = default;
};
/// coefficient times one or more factors, none of which is a literal,
/// a product or shares its base with another.
struct Product {
  Number coefficient;
  std::vector<NodeId> factors;
  bool operator==(const Product&) const = default;
};
/// base^exponent with exponent != 0, 1. Symbolic exponents become exp(y log x).
struct Power {
  NodeId base;
  Number exponent;
  bool operator==(const Power&) const = default;
};
struct Call {
  Function function;
  NodeId argument;
  bool operator==(const Call&) const = default;
};

using Node = std::variant<Literal, Symbol, Sum, Product, Power, Call>;

/// Visitor made of lambdas, one a kind: std::visit(overloaded{...}, node) compiles only when it handles all.
template <class... Cases>
struct overloaded : Cases... {
  using Cases::operator()...;
};
template <class... Cases>
overloaded(Cases...) -> overloaded<Cases...>;  // Clang 14 does not deduce it for aggregates by itself (P1816)

}  // namespace qdot
