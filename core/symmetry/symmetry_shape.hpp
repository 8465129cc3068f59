#pragma once
// What a symmetry does, told by the elementary changes that it is a sum of: a shift, a rotation, a turn of
// one body, a change of time.

#include <cstddef>
#include <optional>
#include <utility>

#include "core/symmetry/listed_quantities.hpp"
#include "core/symmetry/symmetries.hpp"

namespace qdot {

/// The coefficient of the last elementary change, which all others are measured by.
[[nodiscard]] Expression leading(const Symmetry& symmetry);

/// The elementary change of the one body that turns about one axis, beside shifts; none for other symmetries.
[[nodiscard]] std::optional<std::size_t> only_turn(const SymmetrySearch& search, const Symmetry& symmetry);

/// Whether all its elementary changes are of this kind, beside what changes L by a time derivative.
[[nodiscard]] bool is_only(const SymmetrySearch& search, const Symmetry& symmetry, ChangeKind kind);

/// Whether it shifts a coordinate that no rotation changes.
[[nodiscard]] bool moves_along(const SymmetrySearch& search, const Symmetry& symmetry);

/// Whether its linear part is A_ij = -A_ji, beside shifts.
[[nodiscard]] bool is_turning(const SymmetrySearch& search, const Symmetry& symmetry);

/// Its kind, and of a rotation how far apart in the scene's order the coordinates are that it mixes.
[[nodiscard]] std::pair<KindOfChange, std::size_t> kind_of(const SymmetrySearch& search,
                                                           const Symmetry& symmetry);

}  // namespace qdot
