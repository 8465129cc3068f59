#pragma once
// The formula of a period beside its number: elementary (elementary_period.hpp), or of a pendulum
//
//   A x'^2/2 - B cos(n x - x0) = h,   n = 1 or 2,   d = h + B its height above the lowest place
//   T = 4/n sqrt(A/B) K(d/(2 B))       where it swings,
//   T = 2 sqrt(2 A/d) K(2 B/d)         for a turn of 2 pi where it goes over the top,
//
// with K(m) the integral of du/sqrt(1 - m sin(u)^2) from 0 to pi/2, written as `ellipk(m)`, as SciPy and
// mpmath call it (Landau, Lifshitz, Mechanics, 3rd ed., section 11, problem 1; Whittaker, Analytical
// Dynamics, 4th ed., section 44).

#include <functional>

#include "core/closed/closed_form.hpp"
#include "core/closed/elementary_period.hpp"
#include "core/numerics/finding.hpp"
#include "core/turning/motion_kind.hpp"

namespace qdot {

/// Writes an expression out, with what it assumes; no value where it is too long.
using WrittenForm = std::function<std::optional<ClosedForm>(const Expression&, const Relations&)>;

/// Of a libration or a rotation; the shortest of the formulas that agree with the number `found`.
[[nodiscard]] std::optional<ClosedForm> period_form(const QuadratureProblem& problem,
                                                    const ExactValues& values, MotionKind motion,
                                                    const Finding& found, const WrittenForm& written);

}  // namespace qdot
