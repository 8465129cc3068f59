#pragma once
// The rates of small departures from a steady motion under constraints in the velocities, by the parameters:
// the first-order equations xi' = R xi of core/steady/rolling_modes.hpp with quotients of polynomials for
// numbers. R falls into blocks; the eigenvalues of one with the characteristic polynomial s^k p(s) that are
// not 0 have formulas where p is linear, quadratic, or quadratic in s^2.

#include "core/closed/exact_mode.hpp"
#include "core/steady/modes.hpp"

namespace qdot {

/// Of `found.modes`, in order, without shapes. A rate or a place that is written as a number stands as its
/// symbol. Throws Error where the algebra grows too large.
[[nodiscard]] std::vector<std::optional<ExactMode>> rolling_forms(const Model& model, const Reals& parameters,
                                                                  const WrittenTexts& written,
                                                                  const Modes& found);

}  // namespace qdot
