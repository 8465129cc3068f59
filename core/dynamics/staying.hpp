#pragma once
// On which kinks of its equations a motion stays.

#include <vector>

namespace qdot {

/// For each kink of the equations of motion, whether the motion stays on it.
using Staying = std::vector<bool>;

}  // namespace qdot
