#pragma once
// The system of an item that expects a formula or an equation, with the parameters that it fixes and the
// words that a submission may use.

#include <memory>
#include <optional>
#include <string>

#include "api/answers/check/grader.hpp"
#include "core/expr/print/notation.hpp"
#include "core/grading/expected_system.hpp"
#include "core/grading/student_parser.hpp"

namespace qdot::api {

struct FormulaSystem {
  explicit FormulaSystem(std::shared_ptr<const Dynamics> of);

  std::shared_ptr<const Dynamics> dynamics;
  ExpectedSystem system;
  Vocabulary vocabulary;
  Notation notation;

  [[nodiscard]] Graph& graph() { return system.graph(); }
  [[nodiscard]] const Scene& scene() const { return system.scene(); }
};

/// Reads "expect": {kind: {"system": ..., "parameters": {...}}} and the names of the item, which stands at
/// that place. None after errors were reported.
[[nodiscard]] std::shared_ptr<FormulaSystem> read_formula_system(const CheckItem& item,
                                                                 const std::string& kind,
                                                                 const ExpectationScope& scope,
                                                                 const Place& place, Errors& errors);

/// The `rtol` of an item's rule, for rounded numbers in formulas; 0 without a rule. What formulas have no use
/// for is reported.
[[nodiscard]] double formula_tolerance(const CheckItem& item, const Place& place, Errors& errors);

/// Why the terms of e cannot be added, such as "V + 7 adds kg*m^2/s^2 to 1"; empty: they can, or numbers
/// stand for letters.
[[nodiscard]] std::string mistake_of_dimension(const FormulaSystem& system, const Expression& e);

/// {"text": ..., "latex": ...}: a formula or an equation as it was read.
[[nodiscard]] Json written(const FormulaSystem& system, const ReadEquation& equation);

/// The values of a state by name, of what is free and of no more than the question speaks of.
[[nodiscard]] Json state_json(const FormulaSystem& system, std::span<const SymbolDomain> symbols,
                              std::span<const double> state);

}  // namespace qdot::api
