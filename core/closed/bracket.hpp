#pragma once
// Equations that one bracket's power solves: the length sqrt(x^2 + l^2) of a spring that pulls a bead to a
// place beside its wire, the cube of a distance in the force of a charge.
//
//   r1 B^p + r2 B^q = 0   gives   B^(q - p) = -r1/r2

#include <optional>

#include "core/expr/rational_function.hpp"
#include "core/expr/surd.hpp"

namespace qdot {

/// base^power = value > 0, of the unknown x.
struct BracketPower {
  Expression x, base;
  Number power;
  RationalFunction value;
};

/// Of e = 0, where a sum that depends on x stands in it with fractional powers, and x in nothing else.
[[nodiscard]] std::optional<BracketPower> bracket_in(Graph& graph, const Polynomial& e, const Expression& x,
                                                     const SignOf& sign);

/// base^exponent by the value; none where that is no product of which roots are taken.
[[nodiscard]] std::optional<Expression> raised(Graph& graph, const BracketPower& bracket,
                                               const Number& exponent, const SignOf& sign);

/// e with all powers of the bracket, or of a multiple of it, as `raised` gives them, those that it gives.
[[nodiscard]] Expression with_bracket_taken(const Expression& e, const BracketPower& bracket,
                                            const SignOf& sign);

}  // namespace qdot
