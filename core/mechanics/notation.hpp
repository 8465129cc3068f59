#pragma once
// How a scene's symbols are written in formulas: the names of parameters, inputs and coordinates, and their
// LaTeX where the scene gives it.

#include "core/expr/print/notation.hpp"
#include "core/mechanics/scene.hpp"

namespace qdot {

[[nodiscard]] Notation notation_of(const Scene& scene);

}  // namespace qdot
