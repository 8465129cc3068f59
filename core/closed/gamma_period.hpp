#pragma once
// The period in a potential U = U0 + A |x|^n with a constant mass (Landau, Lifshitz, Mechanics, 3rd ed.,
// section 11, problem 2a):
//
//   T = 2/n sqrt(2 pi m/F) (F/A)^(1/n) Gamma(1/n)/Gamma(1/n + 1/2),   F = h - U0

#include <optional>

#include "core/closed/elementary_period.hpp"

namespace qdot {

struct GammaPeriod {
  Expression factor;  ///< T without the quotient of gamma functions
  int n{};
};

/// No value for other potentials, and for n < 3: those are elementary.
[[nodiscard]] std::optional<GammaPeriod> gamma_period(const QuadratureProblem& problem,
                                                      const ExactValues& values);

/// Gamma(1/n)/Gamma(1/n + 1/2), to a few units in the last place.
[[nodiscard]] double gamma_quotient(int n);

}  // namespace qdot
