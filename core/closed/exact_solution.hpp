#pragma once
// The parameter that holds a position as a formula.

#include "core/closed/closed_form.hpp"
#include "core/dynamics/dynamics.hpp"
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

}  // namespace qdot
