#pragma once
// Compiled functions of a model's motions, its inputs replaced by functions of time. Each function takes the
// parameters first (CompiledFunction::bind), then t and the state y = (q, q'). Nothing is kept here; Dynamics
// (core/dynamics/dynamics.hpp) keeps what several questions want.
//
//   M(q,t) q'' = f(q,q',t)
//   M dq''/dy = df/dy - dM/dy q''      for every component of y
//
// Where the equations have kinks, `staying` tells on which of them the motion stays; the kinks' sides are
// then parameters behind the model's own (core/dynamics/motion_builder.hpp). Without it abs and sign are
// functions like others.
//
// All throw Error(syntax | unknown_symbol | too_large) for an input that does not parse, and, given
// `staying`, Error(not_applicable) where that cannot be.

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/compile/compiled_function.hpp"
#include "core/dynamics/inputs.hpp"
#include "core/dynamics/staying.hpp"
#include "core/mechanics/model.hpp"

namespace qdot {

/// q'', n outputs.
[[nodiscard]] CompiledFunction accelerations_of(const Model& model, const InputTexts& inputs,
                                                const Staying* staying = nullptr);

/// d(q', q'')/d(q, q'), 2n x 2n by rows.
[[nodiscard]] CompiledFunction jacobian_of(const Model& model, const InputTexts& inputs,
                                           const Staying* staying = nullptr);

/// Expressions of a graph that was copied from the model's, as they are along motions:
/// q'' solved for, inputs replaced.
[[nodiscard]] CompiledFunction compiled_along_motion(const Model& model, const InputTexts& inputs,
                                                     const Graph& graph,
                                                     std::span<const Expression> expressions,
                                                     const Staying* staying = nullptr);

/// One of them as a function of (q, q', q''), for where q'' is known; none where it does not need q'', or
/// multipliers as well.
[[nodiscard]] std::optional<CompiledFunction> compiled_by_accelerations(const Model& model,
                                                                        const InputTexts& inputs,
                                                                        const Graph& graph,
                                                                        const Expression& of_graph);

/// An event: the function whose zero it is, which way that is crossed, and optionally where a zero counts
/// (when > 0).
struct CompiledEvent {
  CompiledFunction value;
  Crossing direction{Crossing::either};
  std::optional<CompiledFunction> when;
};

/// "theta = 0+": an expression in t, q, q' and the parameters, a value, and a last + or - for the direction;
/// or the name of one of the scene's events. `exponents`: parameters that are put in where they are exponents
/// of what may be negative. Throws Error(syntax | unknown_symbol | too_large).
[[nodiscard]] CompiledEvent compiled_event(const Model& model, const InputTexts& inputs,
                                           const std::string& text, const ExponentValues& exponents = {},
                                           const Staying* staying = nullptr);

}  // namespace qdot
