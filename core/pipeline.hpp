#pragma once
// The stages in order. Everything after the scene is a pure function of it.
//
//   Scene                what is where, as text                          core/mechanics/scene.hpp
//     parse_scene          every symbol known, every dimension checked   core/mechanics/parsed_scene.hpp
//   ParsedScene
//     derive_lagrangian    T, V, Q from positions; L = T - V             core/mechanics/lagrangian.hpp
//   Lagrangian
//     derive_equations     M(q,t) q'' = f(q,q',t) core/mechanics/equations_of_motion.hpp
//   EquationsOfMotion
//     build_model          the four above in one call                    core/mechanics/model.hpp
//   Model
//     Dynamics             tapes for q'', Jacobian, columns, events      core/analysis/dynamics.hpp
//   CompiledFunction                                                     core/compile/compiled_function.hpp
//     integrate            stepping, events, sampling                    core/integrate/run.hpp
//   Run
//     simulate             a motion with its columns and how it ended    core/analysis/simulation.hpp
//   Simulation
//
// Beside the road: what is conserved and why (mechanics/conserved.hpp), momenta, Hamiltonian and Routhian
// (mechanics/canonical.hpp), dimensionless form (mechanics/dimensionless.hpp), printing (expr/print.hpp).

#include "core/analysis/dynamics.hpp"
#include "core/analysis/simulation.hpp"
#include "core/mechanics/canonical.hpp"
#include "core/mechanics/conserved.hpp"
#include "core/mechanics/dimensionless.hpp"
#include "core/mechanics/model.hpp"
