#pragma once
// The error of a motion, measured: the ladder.
//
// A local tolerance says nothing of the error of the answer, which is larger by a factor that depends on the
// motion, from ten to a million. So a motion is computed twice, the second time a hundred times tighter and
// by another method or order; where the second is much more accurate, the difference of the two is the error
// of the first. The returned motion is the first, and its error is twice the largest difference met up to
// each instant (row_errors.hpp), and what the second may be off by. The second has parameters and initial
// values changed in their last bits, so that a difference is not small by chance, and what the motion makes
// of that change and of the second's own steps counts (core/integrate/separation.hpp): it may be as large as
// the first one's error, and of the other sign. Where both are as tight as double precision allows, what
// rounding does to the motion, that of the numbers that were typed included, is measured in double-doubles
// (extended_motion.hpp, extended_impacts.hpp, extended_kinks.hpp). A motion that cannot be followed so, or
// not to its end, is computed a third time, from the other side. Where the true motion may go another way
// than all of these, it is computed on that, too (other_ways.hpp).
//
// A method of fixed step has no tolerances:
// it is checked by the tightest run there is, and does not climb.
//
// A wanted error is reached by climbing: the error at one tolerance tells the next one to try, until the
// wanted error is met, the allowed work is spent, or the last rung is reached. A check that shows early that
// its motion does not meet it is given up (error_growth.hpp). And where a motion is so far below what is
// wanted that rounding hides its error, a looser one is returned whose error the same check tells: more
// digits would cost several times as much.

#include "core/motion/accuracy_goal.hpp"
#include "core/motion/measured_simulation.hpp"

namespace qdot {

/// Method taylor is replaced by bdf where damping is strong; Simulation::method says which one was used. For
/// goals other than tolerances the request's tolerances are ignored. Throws std::invalid_argument for a
/// method of fixed step with such a goal.
[[nodiscard]] MeasuredSimulation simulate_with_error(const Dynamics& dynamics,
                                                     const SimulationRequest& request,
                                                     const AccuracyGoal& goal);

}  // namespace qdot
