#pragma once
// The parameter that holds a position, and the critical values of a parameter, as formulas.

#include "core/closed/closed_form.hpp"
#include "core/dynamics/dynamics.hpp"
#include "core/steady/bifurcations.hpp"
#include "core/steady/solve_for.hpp"

namespace qdot {

/// By the parameters and the coordinates of the position, where the forces are polynomials of the unknown.
struct ExactSolution {
  std::optional<ClosedForm> value;  ///< Omega(theta) of a steady rotation, psi_dot(theta) of a cone
  std::optional<ClosedForm> rate2;  ///< omega^2 of small oscillations about it
};

/// Of `found.values`, in order.
[[nodiscard]] std::vector<ExactSolution> exact_solutions(const Dynamics& dynamics, const Reals& parameters,
                                                         const Reals& y, const std::string& unknown,
                                                         const WrittenTexts& written, const Solution& found);

/// Of `found.critical`, in order, by the other parameters: where the equilibrium has a formula, and det K or
/// a force there is a linear or quadratic polynomial of parameter number `index`.
[[nodiscard]] std::vector<std::optional<ClosedForm>> exact_critical_values(const Dynamics& dynamics,
                                                                           const Reals& parameters,
                                                                           const Reals& y, std::size_t index,
                                                                           const WrittenTexts& written,
                                                                           const Bifurcations& found);

}  // namespace qdot
