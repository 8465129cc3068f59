#pragma once
// The formula of a period beside its number: elementary (elementary_period.hpp), or of a pendulum
//
//   A x'^2/2 - B cos(x) = h,   T = 4 sqrt(A/B) K(m),   m = (h + B)/(2 B)
//
// with K(m) the integral of du/sqrt(1 - m sin(u)^2) from 0 to pi/2, written as `ellipk(m)`, as SciPy and
// mpmath call it (Landau, Lifshitz, Mechanics, 3rd ed., section 11, problem 1).

#include <functional>

#include "core/closed/closed_form.hpp"
#include "core/closed/elementary_period.hpp"
#include "core/numerics/finding.hpp"

namespace qdot {

/// Writes an expression out, with what it assumes; no value where it is too long.
using WrittenForm = std::function<std::optional<ClosedForm>(const Expression&, const Relations&)>;

/// Of a libration; the shortest of the formulas that agree with the number `found`.
[[nodiscard]] std::optional<ClosedForm> period_form(const QuadratureProblem& problem,
                                                    const ExactValues& values, const Finding& found,
                                                    const WrittenForm& written);

}  // namespace qdot
