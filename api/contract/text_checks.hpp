#pragma once
// Rules about the expressions in a request. They need the symbols of the system, but no mechanics; what they
// find becomes an error of the request.

#include <string>
#include <vector>

#include "api/contract/findings.hpp"
#include "api/contract/system_choice.hpp"

namespace qdot::api {

/// Each event is the name of one of the scene's, or an equation in t, the coordinates, velocities and
/// parameters.
void check_events(const Scene& scene, const std::vector<std::string>& events, Findings& findings);

/// Each input is an expression in t and the parameters. Finds nothing more where the system or the field
/// `inputs` is wrong already.
void check_inputs(const SystemChoice& choice, Findings& findings);

}  // namespace qdot::api
