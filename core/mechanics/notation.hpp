#pragma once
// How a scene's symbols are written.

#include "core/expr/print/notation.hpp"
#include "core/mechanics/scene.hpp"

namespace qdot {

[[nodiscard]] Notation notation_of(const Scene& scene);

}  // namespace qdot
