#pragma once
// Where a motion starts, as seen by one coordinate that moves between a smallest and a largest value: at one
// of these turning points, between them, or at rest for ever.

namespace qdot {

enum class InitialPlace { minimum, maximum, between, equilibrium };

}  // namespace qdot
