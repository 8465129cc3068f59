#pragma once
// The inputs of a scene: functions of the time that a request supplies, such as a force F(t).

#include <string>
#include <vector>

#include "core/mechanics/model.hpp"

namespace qdot {

/// For each input of the scene an expression in t and the parameters.
/// An empty text, or none, means the default.
using InputTexts = std::vector<std::string>;

/// Each input u and its derivatives u', u'' as functions of time, in `graph`, a copy of the model's. Throws
/// Error(syntax | unknown_symbol | too_large) for a text that does not parse.
[[nodiscard]] std::vector<Replacement> input_replacements(const Model& model, const InputTexts& inputs,
                                                          Graph& graph);

}  // namespace qdot
