#pragma once
// What is said of a slip: its kind, and the term of the submission that has it. Nothing that only the right
// formula has.

#include "api/answers/check/formula_system.hpp"
#include "core/grading/slip.hpp"

namespace qdot::api {

/// What a submission is compared with to find the slip. Formulas, or residuals of equations.
struct Compared {
  Expression submitted;  ///< as it was read
  Expression expected;   ///< fixed parameters put in
  bool are_equations{};
  std::vector<Expression> inertia{};  ///< core/grading/inertia_changes.hpp
};

/// {"slip": "sign", "text": ...}; null where no single slip explains the submission.
[[nodiscard]] Json diagnosis_json(const FormulaSystem& formula, const Compared& compared, std::uint64_t seed,
                                  bool reveal);

}  // namespace qdot::api
