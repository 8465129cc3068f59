#pragma once
// The rational number that an expression is once its symbols have rational values.

#include <functional>
#include <optional>

#include "core/expr/expression.hpp"

namespace qdot {

/// None where a symbol has none, or what is done with them is more than + - * / and whole powers, or where
/// the number has more digits than are kept.
[[nodiscard]] std::optional<Number> exact_number(
    const Expression& e, const std::function<std::optional<Number>(const Expression& symbol)>& of_symbol);

}  // namespace qdot
