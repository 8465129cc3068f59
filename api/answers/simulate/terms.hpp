#pragma once
// What the words of a request for a motion mean in core's terms.

#include <vector>

#include "api/answers/answers.hpp"
#include "api/answers/simulate/request.hpp"
#include "core/motion/ladder.hpp"

namespace qdot::api {

inline constexpr const char* csv_type = "text/csv";
inline constexpr const char* ndjson_type = "application/x-ndjson";

/// JSON, CSV or NDJSON: what the request says, or else the Accept header.
[[nodiscard]] Format format_of(const SimulateRequest& request, const Call& call);

[[nodiscard]] AccuracyGoal goal_of(const SimulateRequest& request);

/// The grid is empty where the last of the impacts that were asked for ends the motion; t_end is then an
/// instant that is surely later.
[[nodiscard]] SimulationRequest core_request(const SimulateRequest& request, const Dynamics& dynamics,
                                             const ResolvedState& state);

/// Rows from the start to the last of `steps` impacts, or to where the motion stops before it, as a first run
/// finds it. Throws Error(not_applicable) where fewer impacts happen.
[[nodiscard]] std::vector<double> grid_to_last_impact(const SimulateRequest& request,
                                                      const Dynamics& dynamics, SimulationRequest core);

}  // namespace qdot::api
