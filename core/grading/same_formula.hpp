#pragma once
// Whether a formula that was submitted is the expected one.

#include <optional>
#include <string_view>

#include "core/grading/expected_system.hpp"
#include "core/grading/vanishing.hpp"

namespace qdot {

struct FormulaVerdict {
  Decision decision{Decision::unknown};
  State counterexample{};
  /// An energy that has another zero of the potential energy than the scene's.
  bool differs_by_constant{};
};

/// Compares at states, accelerations being those of the right motion. `name` is that of the quantity, "V", or
/// empty: energies are free up to a constant of the potential energy's parameters. `tolerance` is that of
/// rounded numbers, as a part of the sum of the sizes of the expected formula's terms.
[[nodiscard]] FormulaVerdict compare_formulas(const ExpectedSystem& system, std::string_view name,
                                              const Expression& submitted, const Expression& expected,
                                              std::uint64_t seed, double tolerance = 0);

/// The value of a formula at a state; none where it has none.
[[nodiscard]] std::optional<double> value_at(const ExpectedSystem& system, const Expression& formula,
                                             const State& state);

}  // namespace qdot
