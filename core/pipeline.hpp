#pragma once
// The stages in order. Everything after the scene is a pure function of it.
//
//   Scene                what is where, as text                        core/mechanics/scene.hpp
//     parse_scene          every symbol known, every dimension checked core/mechanics/parsed_scene.hpp
//   ParsedScene
//     derive_lagrangian    T, V, Q from positions; L = T - V           core/mechanics/lagrangian.hpp
//   Lagrangian
//     derive_equations     M(q,t) q'' = f(q,q',t)                      core/mechanics/equations_of_motion.hpp
//   EquationsOfMotion
//     build_model          the four above in one call                  core/mechanics/model.hpp
//   Model
//     accelerations_of     tapes for q'', Jacobian, columns, events    core/dynamics/motion_functions.hpp
//   CompiledFunction                                                   core/compile/compiled_function.hpp
//     Dynamics             what questions share, made once and kept    core/dynamics/dynamics.hpp
//     integrate            stepping, events, sampling                  core/integrate/integrate.hpp
//   Run
//     simulate             a motion with its columns and how it ended  core/motion/simulation.hpp
//   Simulation
//
// Beside the road, of a Lagrangian:
//   what is conserved, and why                                         core/mechanics/conserved.hpp
//   which small changes leave it as it is                              core/symmetry/found_quantities.hpp
//   momenta, Hamiltonian and Routhian                                  core/mechanics/canonical.hpp
//   dimensionless form                                                 core/mechanics/dimensionless.hpp
//   printing                                                           core/expr/print/print.hpp
// Of a motion:
//   its error, measured                                                core/motion/ladder.hpp
//   motions with impacts that repeat                                   core/gait/gait.hpp
//   such motions followed while a parameter changes                    core/gait/gait_continuation.hpp
// Questions that need no motion:
//   without ignorable coordinates                                      core/mechanics/reduction.hpp
//   with the parameters that are zero                                  core/dynamics/specialization.hpp
//   compiled at rest                                                   core/dynamics/statics.hpp
//   in intervals, balls and divided differences                        core/compile/tape_evaluator.hpp
//   equilibria and what holds them                                     core/steady/equilibria.hpp
//   small motions about them                                           core/steady/modes.hpp
//   where their number or stability changes                            core/steady/bifurcations.hpp
//   how far a motion of one coordinate goes                            core/turning/turning_points.hpp
// As formulas, with the signs that they assume:
//   places                                                              core/closed/exact_equilibrium.hpp
//   shapes and rates of modes                                          core/closed/exact_modes.hpp
//   turning points and periods                                         core/closed/exact_turning.hpp
//
// Of submissions:
//   formulas as people write them                                      core/grading/student_parser.hpp
//   whether one is right                                               core/grading/same_formula.hpp
//   the slip in it                                                     core/grading/slip.hpp
//   whether equations have the right motion for solutions              core/grading/same_motion.hpp
//
// The rooms, and which may use which: core/CMakeLists.txt.

#include "core/dynamics/dynamics.hpp"
#include "core/gait/gait.hpp"
#include "core/gait/gait_continuation.hpp"
#include "core/mechanics/canonical.hpp"
#include "core/mechanics/conserved.hpp"
#include "core/mechanics/dimensionless.hpp"
#include "core/mechanics/model.hpp"
#include "core/motion/ladder.hpp"
#include "core/motion/simulation.hpp"
#include "core/steady/bifurcations.hpp"
#include "core/steady/equilibria.hpp"
#include "core/steady/modes.hpp"
#include "core/turning/turning_points.hpp"
