#pragma once
// What depends on which parameters are zero. Without gravity a pendulum keeps its momentum, without a foot's
// mass an equation vanishes: so the parameters that are 0 are put into the Lagrangian before more is derived
// from it. Every function works on a copy of the model's graph and keeps nothing.

#include <memory>
#include <span>
#include <vector>

#include "core/compile/compiled_function.hpp"
#include "core/dynamics/inputs.hpp"
#include "core/dynamics/statics.hpp"
#include "core/mechanics/conserved.hpp"
#include "core/symmetry/found_quantities.hpp"

namespace qdot {

/// For each parameter, whether it is 0 exactly: one that cancels in all digits that are kept may not be.
using Vanishing = std::vector<bool>;
[[nodiscard]] Vanishing vanishing_among(const Reals& parameters);

/// What stays constant along motions with given parameters.
struct Conserved {
  std::vector<ConservedQuantity> quantities;  ///< in a graph of their own
  std::shared_ptr<const CompiledFunction> values;
};

/// The Lagrangian with vanishing parameters and the inputs replaced, in a graph of its own.
[[nodiscard]] Lagrangian specialized(const Model& model, const InputTexts& inputs,
                                     const Vanishing& vanishing);

[[nodiscard]] Conserved derive_conserved(const Model& model, const InputTexts& inputs,
                                         const Vanishing& vanishing);

/// The same for what symmetries of several coordinates keep constant, which takes a search.
[[nodiscard]] Conserved derive_found(const Model& model, const InputTexts& inputs,
                                     const Vanishing& vanishing);

/// Throws Error(not_applicable) where the time enters the equations.
[[nodiscard]] Statics derive_statics(const Model& model, const InputTexts& inputs,
                                     const Vanishing& vanishing);

}  // namespace qdot
