#pragma once
// Lagrangians that contain the time only by a total derivative: L and L - dF/dt have the same equations of
// motion for every F(q, t) (Landau and Lifshitz, Mechanics, 3rd ed., section 2). In a car that accelerates,
// m l a t phi' cos(phi) is d/dt(m l a t sin(phi)) - m l a sin(phi): a pendulum there has a potential.

#include <optional>
#include <span>

#include "core/expr/expression.hpp"

namespace qdot {

/// L without dF/dt and without terms of t alone, where that leaves no t; `rates` are q'. F is looked for
/// among powers, sines, cosines and exponentials of one coordinate in each term. No value where L contains no
/// t.
[[nodiscard]] std::optional<Expression> without_explicit_time(const Expression& lagrangian,
                                                              std::span<const Expression> q,
                                                              std::span<const Expression> rates,
                                                              const Expression& t);

}  // namespace qdot
