#pragma once
// What an answer says of a motion beside its rows, as JSON: what was conserved and how well, where and when
// it stuck on a kink, and its impacts.

#include <cstdint>

#include "api/json/json.hpp"
#include "core/motion/simulation_result.hpp"

namespace qdot::api {

/// `total_evaluations`: of all computations that the answer has taken.
[[nodiscard]] Json diagnostics_json(const Simulation& motion, std::uint64_t total_evaluations);
/// The stays on kinks, in order of time.
[[nodiscard]] Json sticking_json(const Simulation& motion);
[[nodiscard]] Json impacts_json(const Scene& scene, const Simulation& motion);

}  // namespace qdot::api
