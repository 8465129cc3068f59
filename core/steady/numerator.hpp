#pragma once
// Forces without their denominators, whose zeros are poles: near one the numerator tells that no zero of the
// force is there.

#include <span>
#include <vector>

#include "core/expr/expression.hpp"

namespace qdot {

/// e times those of its denominators that contain one of the variables; e itself where there are none.
[[nodiscard]] Expression numerator_of(const Expression& e, std::span<const Expression> variables);

/// What those denominators are powers of: where one vanishes e has no value, or none that its numerator
/// tells.
[[nodiscard]] std::vector<Expression> denominators_of(const Expression& e,
                                                      std::span<const Expression> variables);

}  // namespace qdot
