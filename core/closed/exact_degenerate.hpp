#pragma once
// Values of a parameter at which a force vanishes everywhere, as formulas: Omega = sqrt(g/p) of a bead on a
// parabola, which then rests anywhere.

#include "core/closed/closed_form.hpp"
#include "core/dynamics/dynamics.hpp"
#include "core/steady/bifurcations.hpp"

namespace qdot {

/// Of `found.degenerate`, in order, where a force, or of up to three coordinates the determinant of their
/// stiffness, has a factor of parameter number `index` alone that is linear or quadratic in it, or in its
/// square.
[[nodiscard]] std::vector<std::optional<ClosedForm>> exact_degenerate_values(
    const Dynamics& dynamics, const Reals& parameters, const Reals& y, std::size_t index,
    const WrittenTexts& written, const Bifurcations& found);

}  // namespace qdot
