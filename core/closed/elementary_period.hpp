#pragma once
// The period of a motion of one coordinate by quadrature, where that is elementary:
//
//   T = 2 integral dx sqrt(A/(2 F)) = 2 integral dw sqrt(A/(2 F w'^2)),   F = h - U(x)
//
// with x, x^2, a sine, a cosine or an exponential for w, of which 2 F w'^2/A is a quotient that
// root_integral.hpp knows: harmonic oscillators in disguise (cycloid, isotropic in the plane), Kepler,
// Morse, -1/cosh^2, tan^2 (Landau, Lifshitz, Mechanics, 3rd ed., sections 11 and 15).

#include <vector>

#include "core/closed/exact_values.hpp"

namespace qdot {

/// h = 1/2 A(x) x'^2 + U(x), by the parameters and what else has a value.
struct QuadratureProblem {
  Expression x, inertia, potential, energy;
};

/// Among these the period is, where it is one of those: a substitution may run through the way once or twice.
/// Every one has to be held against the number.
[[nodiscard]] std::vector<Expression> elementary_periods(const QuadratureProblem& problem,
                                                         const ExactValues& values);

}  // namespace qdot
