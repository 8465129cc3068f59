#pragma once
// Small changes x -> x + s xi(x), affine in the coordinates, that leave U(x) as it is: shifts and turns of
// all that is there, in the plane or in space. Where g = dU/dx vanishes, U is stationary, and stays so along
// them:
//
//   xi . dU/dx = 0 identically,  so that at a zero of g  K xi = 0, exactly,
//
// and every place that they lead to is an equilibrium like it (core/symmetry has how they are found).

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/dynamics/statics.hpp"

namespace qdot {

/// xi_i(x) of each, n outputs beside n outputs, functions of the statics' constants and x. More than are
/// independent at a place. None where there are none, where the forces at rest have no potential, and where
/// the search grows too large.
[[nodiscard]] std::optional<CompiledFunction> symmetric_changes(const Statics& statics);

/// The place in x of each coordinate that moves, and how far, written in the parameters and the coordinates.
using WrittenChange = std::vector<std::pair<std::size_t, std::string>>;

/// Those among them that move every place by the same, as geared shafts that turn together; and the others,
/// as a turn about a place.
[[nodiscard]] std::vector<WrittenChange> symmetric_shifts(const Statics& statics);
[[nodiscard]] std::vector<WrittenChange> symmetric_turns(const Statics& statics);

}  // namespace qdot
