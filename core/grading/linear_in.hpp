#pragma once
// Whether expressions are linear in some symbols, kinks and denominators looked at.

#include <optional>
#include <span>

#include "core/expr/expression.hpp"

namespace qdot {

/// Whether |x| or sign(x) of what changes with the symbols stands in e: its derivatives do not tell all of
/// it.
[[nodiscard]] bool has_kink_in(const Expression& e, std::span<const Expression> symbols);

/// Whether all second derivatives with respect to the symbols vanish, as far as algebra can tell.
[[nodiscard]] bool is_linear_in(const Expression& e, std::span<const Expression> symbols);

/// e when it is linear, else e times what stands below its bars when that is; none where neither is.
[[nodiscard]] std::optional<Expression> made_linear_in(const Expression& e,
                                                       std::span<const Expression> symbols);

}  // namespace qdot
