#pragma once
// What linear constraints A x = b leave free: by elimination with the largest pivots as many x_D as A has
// rows are solved for.
//
//   x = Z x_F,  A Z = 0             the free x_F stand in Z with rows of the unit matrix
//   x_D = A_D^-1 b,  x_F = 0        a solution of A x = b

#include <vector>

#include "core/numerics/ball.hpp"

namespace qdot {

using BallMatrix = std::vector<std::vector<Ball>>;

struct SolvedSlopes {
  BallMatrix allowed;                  ///< Z: for each unknown that is left free a column
  std::vector<std::size_t> dependent;  ///< D, by row of A
  std::vector<std::size_t> free;       ///< F, by column of Z
  BallMatrix inverse;                  ///< of A_D
};

/// A has n columns. Throws Error(not_applicable) where its rows depend on each other.
[[nodiscard]] SolvedSlopes solved_slopes(BallMatrix a, std::size_t n);

}  // namespace qdot
