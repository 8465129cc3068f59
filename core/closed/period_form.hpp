#pragma once
// The formula of a period beside its number: elementary (elementary_period.hpp), or by the elliptic integral
// K(m) (elliptic_period.hpp), written as `ellipk(m)`, as SciPy and mpmath call it.

#include <functional>

#include "core/closed/closed_form.hpp"
#include "core/closed/elementary_period.hpp"
#include "core/numerics/finding.hpp"
#include "core/turning/motion_kind.hpp"

namespace qdot {

/// Writes an expression out, with what it assumes; no value where it is too long.
using WrittenForm = std::function<std::optional<ClosedForm>(const Expression&, const Relations&)>;

/// factor, factor K(m), or factor Gamma(1/n)/Gamma(1/n + 1/2).
struct PeriodFormula {
  ClosedForm form;
  Expression factor;
  Relations relations{};  ///< that were put in
  std::optional<Expression> m{};
  int n{};

  /// To a few digits, where the symbols in it have these values.
  [[nodiscard]] double value_at(const std::vector<RealAssignment>& values) const;
};

/// Of a libration or a rotation; the shortest of the formulas that agree with the number `found`.
[[nodiscard]] std::optional<PeriodFormula> period_form(const QuadratureProblem& problem,
                                                       const ExactValues& values, MotionKind motion,
                                                       const Finding& found, const WrittenForm& written);

}  // namespace qdot
