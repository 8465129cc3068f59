#pragma once
// The signs that a function takes on an interval, when it is known as a polynomial and a bound of the rest:
//
//   |g(u) - sum_k c_k u^k| <= r    for 0 <= u <= 1.
//
// In Bernstein's form the coefficients enclose the values, and the number of their changes of sign bounds the
// number of zeros (Descartes' rule). Cells in which they do not tell are halved by de Casteljau's algorithm.
// Where the polynomial is nowhere larger than a few r its sign is in doubt.
// Source: Mourrain, Rouillier, Roy, The Bernstein basis and real root isolation, in Combinatorial and
// Computational Geometry, MSRI Publications 52 (2005) 459.

#include <span>
#include <vector>

namespace qdot {

/// g has this sign in [from, to]; 0 where that is in doubt. Between neighbouring pieces of opposite signs
/// that do not touch, the polynomial has one zero.
struct SignPiece {
  double from{};
  double to{};
  int sign{};
};

/// The pieces of [0, 1] from left to right. At most largest_degree + 1 coefficients.
inline constexpr std::size_t largest_degree = 24;
[[nodiscard]] std::vector<SignPiece> signs_of(std::span<const double> coefficients, double remainder);

}  // namespace qdot
