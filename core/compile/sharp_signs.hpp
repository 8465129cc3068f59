#pragma once
// The signs of a function along a way, beyond the rounding of doubles: where a polynomial that is multiplied
// out has a multiple root, doubles do not tell its sign over eps^(1/m) of its size.
//
// The function's coefficients along the way are enclosed in twice the digits, and what follows them over the
// whole piece (core/numerics/taylor_enclosure.hpp), so that no change of sign lies where none is listed.

#include <span>
#include <vector>

#include "core/compile/compiled_function.hpp"
#include "core/numerics/ball.hpp"
#include "core/numerics/sign_search.hpp"

namespace qdot {

/// A function of one output along y_i(t + s) = sum_k rows[i terms + k] s^k.
struct FunctionAlong {
  const CompiledFunction& function;
  std::span<const Ball> parameters;
  double t{};
  std::span<const double> rows;
  std::size_t terms{};
  std::span<const Ball> start{};  ///< y(t), where more is known of it than a double; else empty
};

/// Its coefficients about s = 0.
[[nodiscard]] std::vector<Ball> sharp_series(const FunctionAlong& g);

/// The pieces of from <= s <= to from left to right, from < to; 0 where even these digits do not tell, or the
/// piece is as short as `shortest`.
[[nodiscard]] std::vector<SignPiece> sharp_signs(const FunctionAlong& g, double from, double to,
                                                 double shortest);
/// The same of dg/ds.
[[nodiscard]] std::vector<SignPiece> sharp_slopes(const FunctionAlong& g, double from, double to,
                                                  double shortest);

}  // namespace qdot
