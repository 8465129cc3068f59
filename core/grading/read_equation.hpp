#pragma once
// An equation as it was read from a submission; or a formula, which has no right side.

#include <optional>

#include "core/expr/expression.hpp"

namespace qdot {

struct ReadEquation {
  Expression left;
  std::optional<Expression> right;  ///< none where there is no equals sign

  /// left - right.
  [[nodiscard]] Expression residual() const { return right ? left - *right : left; }
};

}  // namespace qdot
