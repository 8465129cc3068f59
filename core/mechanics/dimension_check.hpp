#pragma once
// Dimensions of expressions: every sum adds like to like.

#include <map>
#include <optional>
#include <string>

#include "core/expr/expression.hpp"
#include "core/mechanics/units.hpp"

namespace qdot {

using SymbolDimensions = std::map<NodeId, Dimension>;

struct DimensionResult {
  /// No value: any dimension fits (the number 0, symbols of unknown dimension), or there is a mistake.
  std::optional<Dimension> dimension;
  std::string mistake;  ///< "l + theta adds m to 1", or empty
};

/// Numbers have no dimension, except that 0 fits any. Arguments of functions have none, angles included
/// (rad = 1).
[[nodiscard]] DimensionResult dimension_of(const Expression& e, const SymbolDimensions& symbols);

}  // namespace qdot
