#pragma once
// The principal moments of inertia of uniform bodies about their centres:
//
//   I_k = m rho_k^2,  rho_k the radius of gyration about the body's axis k = 1, 2, 3
//
// Axis 3 is that of a disk, ring or cylinder; in the plane, every body turns about its axis 3. Source:
// Meriam, Kraige and Bolton, Engineering Mechanics: Dynamics, 8th ed., table D/4.

#include <array>
#include <span>
#include <string>
#include <vector>

#include "core/expr/expression.hpp"

namespace qdot {

/// A length that a shape has.
struct ShapeSize {
  std::string name;     ///< "radius"
  std::string meaning;  ///< "its radius"
  bool along_axis_3{};  ///< I_3 does not depend on it: a body in the plane goes without
};

struct Shape {
  std::string name;     ///< "disk", the kind of such a body
  std::string meaning;  ///< "A uniform disk, thin along its axis."
  std::vector<ShapeSize> sizes;
  /// rho_k^2 from the sizes in their order; one along axis 3 may be 0 where only rho_3 is used.
  std::array<Expression, 3> (*gyration_squared)(std::span<const Expression> sizes);
  bool rolls{};  ///< its first size is the radius on which it rolls about axis 3
};

[[nodiscard]] const std::vector<Shape>& shapes();

/// Null where there is none of that name.
[[nodiscard]] const Shape* find_shape(const std::string& name);

}  // namespace qdot
