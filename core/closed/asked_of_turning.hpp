#pragma once
// What may decide where formulas of turning points hold: each sign that is asked for may be assumed.

#include "core/closed/assumed_signs.hpp"
#include "core/closed/elementary_period.hpp"
#include "core/closed/turning_equation.hpp"

namespace qdot {

[[nodiscard]] inline Expression with_value(const Expression& e, const Expression& x,
                                           const Expression& value) {
  const Replacement there{x, value};
  return substitute(e, {&there, 1});
}

/// Those of what functions of x have for factors: (A - B) of (A - B)/sin(x)^2.
void ask_coefficients(const Expression& potential, const Expression& x, AssumedSigns& signs);

/// The sums of a formula, what it divides by, and what it takes roots of.
void ask_parts(const Expression& formula, AssumedSigns& signs);

/// What has to be positive for it to be real.
void ask_values(const Expression& formula, AssumedSigns& signs);

/// What is left of the energy at a place between the ends, and which way the force goes there.
void ask_between(const QuadratureProblem& problem, const Expression& place, AssumedSigns& signs);

/// The same of the places that a motion may have to pass.
void ask_about(const TurningEquation& equation, const QuadratureProblem& problem, AssumedSigns& signs);

}  // namespace qdot
