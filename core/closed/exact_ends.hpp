#pragma once
// Values of a parameter at which an equilibrium comes from infinity or goes there, as formulas: the spring on
// a turning arm, whose rest k*r0/(k - m*w^2) is nowhere at w = sqrt(k/m).

#include "core/closed/closed_form.hpp"
#include "core/dynamics/dynamics.hpp"
#include "core/steady/bifurcations.hpp"

namespace qdot {

/// Of `found.at_ends`, in order, where one coordinate is left and the force is a polynomial of it whose
/// leading coefficient vanishes there, but not the next: the two say that x is about -next/leading, far out.
[[nodiscard]] std::vector<std::optional<ClosedForm>> exact_end_values(const Dynamics& dynamics,
                                                                      const Reals& parameters, const Reals& y,
                                                                      std::size_t index,
                                                                      const WrittenTexts& written,
                                                                      const Bifurcations& found);

}  // namespace qdot
