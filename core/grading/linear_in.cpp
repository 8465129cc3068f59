#include "core/grading/linear_in.hpp"

#include <algorithm>
#include <array>

#include "core/expr/calculus.hpp"
#include "core/expr/zeroness.hpp"
#include "core/grading/ball_values.hpp"

namespace qdot {

bool has_kink_in(const Expression& e, std::span<const Expression> symbols) {
  const std::array roots{e};
  return std::ranges::any_of(BallValues(roots).kinks(),
                             [&](const Expression& argument) { return depends_on(argument, symbols); });
}

bool is_linear_in(const Expression& e, std::span<const Expression> symbols) {
  if (has_kink_in(e, symbols)) return false;
  for (const Expression& a : symbols) {
    const Expression slope = differentiate(e, a);
    for (const Expression& b : symbols) {
      const Expression second = differentiate(slope, b);
      if (!second.is_zero() && zeroness(second) != Zeroness::zero) return false;
    }
  }
  return true;
}

std::optional<Expression> made_linear_in(const Expression& e, std::span<const Expression> symbols) {
  if (is_linear_in(e, symbols)) return e;
  const auto above = numerator(e);
  return above && is_linear_in(*above, symbols) ? above : std::nullopt;
}

}  // namespace qdot
