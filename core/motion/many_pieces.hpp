#pragma once
// Kinks that follow each other without end, as those of a force that sways about its kink.

#include "core/motion/simulation_request.hpp"
#include "core/motion/simulation_result.hpp"

namespace qdot {

/// Whether kinks follow each other so fast, and no more slowly than before, that the steps which are left are
/// far too few for the rest.
[[nodiscard]] bool takes_too_many_pieces(const Simulation& so_far, const SimulationRequest& request);

}  // namespace qdot
