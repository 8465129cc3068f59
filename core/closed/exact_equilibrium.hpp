#pragma once
// A place of rest or steady motion among all of them, as formulas: those that its small motions have, too
// (exact_modes.hpp).

#include "core/closed/closed_form.hpp"
#include "core/dynamics/dynamics.hpp"
#include "core/steady/bounded_state.hpp"

namespace qdot {

struct ExactEquilibrium {
  std::vector<std::optional<ClosedForm>> state;  ///< of the coordinates
  std::optional<ClosedForm> rate2;               ///< of one degree of freedom; below 0 where it grows
};

/// `momenta`: of the ignored coordinates.
[[nodiscard]] ExactEquilibrium exact_equilibrium(const Dynamics& dynamics, const Reals& parameters,
                                                 const WrittenTexts& written, const SteadyState& found,
                                                 const std::vector<Real>& momenta);

}  // namespace qdot
