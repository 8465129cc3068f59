#pragma once
// Numbers that every room needs by a short name, each the double nearest to it.

#include <limits>
#include <numbers>

namespace qdot {

inline constexpr double infinity = std::numeric_limits<double>::infinity();
inline constexpr double pi = std::numbers::pi;

}  // namespace qdot
