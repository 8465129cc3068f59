#pragma once
// A formula beside a number: what it is in the scene's parameters, and what it assumes.

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/closed/exact_values.hpp"

namespace qdot {

struct ClosedForm {
  std::string text, latex;
  /// "l > 0", "k = 2*m*g/l": signs of the parameters in it, and what was put in.
  std::vector<std::string> assumes;
};

/// The longest formula that is shown, as written_length counts.
inline constexpr std::size_t longest_closed_form = 90;

/// Beside the parameters' signs, those of other symbols in e, which have values.
void assume_signs(ClosedForm& form, const ExactValues& values, const Expression& e,
                  std::span<const Expression> symbols);

/// Whether the value of the formula and a number, known to within `error`, agree within both bounds.
[[nodiscard]] bool agrees(const Real& formula, double number, double error);

/// As it is written: with one root for each kind, factors and squares.
[[nodiscard]] Expression short_form(const ExactValues& values, const Expression& formula);

/// The formula, an expression of `values.graph()`, written out. `relations`: what was put in. No value
/// where it is too long, or speaks of what is no parameter nor in `allowed`.
[[nodiscard]] std::optional<ClosedForm> closed_form(const ExactValues& values, const Expression& formula,
                                                    const Relations& relations,
                                                    std::span<const Expression> allowed = {},
                                                    std::size_t longest = longest_closed_form);

}  // namespace qdot
