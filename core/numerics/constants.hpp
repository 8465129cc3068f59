#pragma once

#include <limits>
#include <numbers>

namespace qdot {

inline constexpr double infinity = std::numeric_limits<double>::infinity();
inline constexpr double pi = std::numbers::pi;

}  // namespace qdot
