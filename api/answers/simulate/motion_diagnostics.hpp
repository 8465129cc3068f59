#pragma once
// What a motion tells of itself beside its rows, as JSON: what it has kept, where it has stuck, its impacts.

#include <cstdint>

#include "api/json/json.hpp"
#include "core/motion/simulation_result.hpp"

namespace qdot::api {

/// `total_evaluations`: of all computations that the answer has taken.
[[nodiscard]] Json diagnostics_json(const Simulation& motion, std::uint64_t total_evaluations);
[[nodiscard]] Json sticking_json(const Simulation& motion);
[[nodiscard]] Json impacts_json(const Scene& scene, const Simulation& motion);

}  // namespace qdot::api
