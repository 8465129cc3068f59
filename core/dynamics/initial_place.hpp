#pragma once

namespace qdot {

/// Where a motion starts between the largest and the smallest value of a coordinate.
enum class InitialPlace { minimum, maximum, between, equilibrium };

}  // namespace qdot
