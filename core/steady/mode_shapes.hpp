#pragma once
// Shapes of modes in all coordinates of a scene. The momenta of ignored coordinates c stay, so that these
// move along with the kept ones x by M_cc u_c = -(M_cx + D_cx/s) u_x.

#include <vector>

#include "core/steady/linearization.hpp"
#include "core/steady/mode.hpp"

namespace qdot {

/// Of modes with one s, from the shapes of the coordinates that `reduced` has.
void set_shapes(const Linearization& at, std::vector<Mode>& modes, const std::vector<Shape>& shapes,
                const ComplexBall& s);

/// Where independent shapes have their first components, in echelon form.
[[nodiscard]] std::vector<std::size_t> first_components(const std::vector<Shape>& shapes);

/// What is left of the shapes where those of `basis`, which is in echelon form, have their first components.
[[nodiscard]] std::vector<Shape> without(const std::vector<Shape>& basis, std::vector<Shape> shapes);

}  // namespace qdot
