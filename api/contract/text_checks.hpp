#pragma once
// Rules about the expressions in a request, which need the system's symbols but no mechanics.

#include <string>
#include <vector>

#include "api/contract/findings.hpp"
#include "api/contract/system_choice.hpp"

namespace qdot::api {

/// Each event is the name of one of the scene's, or an equation in t, the coordinates, velocities and
/// parameters.
void check_events(const Scene& scene, const std::vector<std::string>& events, Findings& findings);

/// Each input is an expression in t and the parameters.
void check_inputs(const SystemChoice& choice, Findings& findings);

}  // namespace qdot::api
