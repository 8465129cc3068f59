#pragma once
// How long an expression is when it is written out, an expression that occurs twice counted twice.

#include <cstddef>
#include <deque>
#include <vector>

#include "core/expr/node.hpp"

namespace qdot {

struct Length {
  /// Additions, multiplications, divisions, powers and calls.
  /// A sign and a fraction of two numbers (3/4) count nothing.
  std::size_t operations{};
  /// Coefficients that are not whole numbers.
  std::size_t fractions{};
};

/// The length of `node` from those of its children.
/// `nodes` and `lengths` are what the arena holds, by number.
[[nodiscard]] Length length_of(const Node& node, const std::deque<Node>& nodes,
                               const std::vector<Length>& lengths);

}  // namespace qdot
