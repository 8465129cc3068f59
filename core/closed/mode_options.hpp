#pragma once
// Formulas that small motions may have, and which of them is that of a mode whose number is known.

#include <vector>

#include "core/closed/exact_place.hpp"
#include "core/closed/mode_derivation.hpp"
#include "core/steady/modes.hpp"

namespace qdot {

/// Each mode in its shortest form: in all parameters, with the relations that are written, or with those that
/// the numbers satisfy, where these leave nothing but a number and the scene's units, and less than half.
[[nodiscard]] std::vector<ModeForms> mode_options(const LinearMotions& motions, const ExactPlace& place,
                                                  const ExactValues& values);

/// The option with the mode's eigenvalue; null where there is none, or more.
[[nodiscard]] const ModeForms* option_of_mode(const std::vector<ModeForms>& options, const Mode& mode,
                                              const ExactValues& values);

[[nodiscard]] bool has_shape(const ModeForms& option, const Mode& mode, const ExactValues& values);

}  // namespace qdot
