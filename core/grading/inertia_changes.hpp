#pragma once
// The moment of inertia about another point: I_end = m L^2/3 for I_centre = m L^2/12 of a slender rod, or the
// other way round, and m r^2/2 + m r^2 for m r^2/2 of a disk.
//
//   dT = m/8 |v_start - v_end|^2 (rods),  m/2 r^2 angle'^2 (disks, rings, balls that roll in the plane)
//
// is what T is then too large or too small by. |v_start - v_end| = L omega, so no angle of the rod is needed.

#include <string_view>
#include <vector>

#include "core/grading/expected_system.hpp"

namespace qdot {

/// What is added to the quantity of that name (T, L, E, h, p_theta) by the slip, for each body, and for all
/// of them where there are several; nothing for other quantities.
[[nodiscard]] std::vector<Expression> inertia_changes(const Model& model, const ExpectedSystem& system,
                                                      std::string_view quantity);

/// What is added to left - right of the equation of that coordinate.
[[nodiscard]] std::vector<Expression> inertia_changes(const Model& model, const ExpectedSystem& system,
                                                      std::size_t coordinate);

}  // namespace qdot
