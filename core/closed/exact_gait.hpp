#pragma once
// The rate of a periodic gait of one degree of freedom that keeps its energy between impacts, such as a
// wheel's on its spokes or a walker's whose feet weigh nothing: with L = M(q) v^2/2 + ... - V(q) and an
// impact (q, v) -> (q_+, c(q) v),
//
//   M(q_+) v_+^2/2 + V(q_+) = M(q) v^2/2 + V(q),   v_+ = c v,
//   v_+^2 = 2 c^2 (V(q_+) - V(q))/(M(q) - c^2 M(q_+)),
//
// and small differences in v^2 are multiplied by c^2 M(q_+)/M(q) from one impact to the next. The place q of
// the impact follows from its event where that speaks of q alone; else formulas are by q_+, which is in the
// answer. Source: McGeer, Passive dynamic walking, Int. J. Robotics Research 9 (1990); Garcia, Chatterjee,
// Ruina and Coleman, The simplest walking model (1998).

#include <complex>
#include <span>

#include "core/closed/closed_form.hpp"
#include "core/dynamics/dynamics.hpp"

namespace qdot {

/// Of a gait that was found: the state just after an impact, and its multipliers.
struct GaitNumbers {
  std::vector<double> state, errors;
  std::span<const std::complex<double>> multipliers;
  std::span<const double> multiplier_errors;
};

struct ExactGait {
  std::size_t coordinate{};              ///< whose rate it is
  ClosedForm square;                     ///< of the rate just after the impact
  std::optional<ClosedForm> multiplier;  ///< where one of those found agrees with it
};

/// No value where there is no such coordinate, or the formula is too long or disagrees with the number.
[[nodiscard]] std::optional<ExactGait> exact_gait(const Dynamics& dynamics, const Reals& parameters,
                                                  const WrittenTexts& written, const GaitNumbers& found);

}  // namespace qdot
