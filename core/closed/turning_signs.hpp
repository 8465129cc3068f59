#pragma once
// What formulas of turning points and periods assume of sums of parameters: that the force at a turning point
// points back to where the motion is, x_max = h/(m*g*(sin(c) - u*cos(c))) on an incline that is steep enough,
// and that there are two of them, pi*sqrt(m/k) between the pole of (b - c)/x^2 and the spring that holds.

#include <optional>
#include <string>
#include <vector>

#include "core/closed/period_form.hpp"
#include "core/closed/turning_equation.hpp"

namespace qdot {

/// The parameters and constants of which nothing is assumed: what a formula assumes of its own symbols is all
/// that holds at other parameters.
[[nodiscard]] std::vector<Expression> not_spoken_of(const TurningEquation& equation,
                                                    const std::vector<std::string>& assumes,
                                                    const std::vector<Expression>& constants);

/// Of the largest (side 1) or smallest (-1) place x, written by the equation's constants, or by the initial
/// state where the equation assumes one. `assumes`: what is assumed anyway. None where the formula is not the
/// turning point at all other parameters at which that holds, and no sign that is known tells where it is.
[[nodiscard]] std::optional<std::vector<std::string>> signs_of_extremum(
    const TurningEquation& equation, const Expression& x, int side, const Relations& relations,
    const std::vector<std::string>& assumes);

/// Of an end at a wall: that the motion has the energy to come there.
[[nodiscard]] std::vector<std::string> signs_of_wall(const TurningEquation& equation, const Expression& wall);

/// The places of walls, by the parameters.
struct WallPlaces {
  std::optional<Expression> below, above;
};

/// Of a period of this problem, which speaks of the equation's constants, or of its parameters alone; none
/// as above.
[[nodiscard]] std::optional<std::vector<std::string>> signs_of_period(const TurningEquation& equation,
                                                                      const QuadratureProblem& problem,
                                                                      const PeriodFormula& period,
                                                                      const WallPlaces& walls);

}  // namespace qdot
