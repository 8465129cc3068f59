#pragma once
// Functions by the words that people have for them.

#include <optional>
#include <string_view>

#include "core/expr/expression.hpp"

namespace qdot {

/// sin, Sin, arcsin, cot, ln, ...; in small or capital letters.
[[nodiscard]] bool is_function_word(std::string_view word);

/// The function of an argument; none where it has no value.
[[nodiscard]] std::optional<Expression> applied(std::string_view word, const Expression& argument);

}  // namespace qdot
