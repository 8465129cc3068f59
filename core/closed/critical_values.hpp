#pragma once
// The critical values of a parameter as formulas.

#include "core/closed/closed_form.hpp"
#include "core/dynamics/dynamics.hpp"
#include "core/steady/bifurcations.hpp"

namespace qdot {

/// Of `found.critical`, in order, by the other parameters: where the equilibrium has a formula, and det K or
/// a force there is a linear or quadratic polynomial of parameter number `index`.
[[nodiscard]] std::vector<std::optional<ClosedForm>> exact_critical_values(const Dynamics& dynamics,
                                                                           const Reals& parameters,
                                                                           const Reals& y, std::size_t index,
                                                                           const WrittenTexts& written,
                                                                           const Bifurcations& found);

}  // namespace qdot
