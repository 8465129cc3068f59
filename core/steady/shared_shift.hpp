#pragma once
// Equilibria that come in families because adding the same to several coordinates changes no force: carts on
// springs between them alone, disks on a shaft. None of them is a point that a search could isolate.

#include <string>
#include <vector>

#include "core/mechanics/scene.hpp"
#include "core/steady/steady_forces.hpp"

namespace qdot {

/// The coordinates of one unit, by place in x, to which the same may be added; empty where that is not so
/// for those of any unit. Of all coordinates that forces depend on, and of scenes without kinks.
[[nodiscard]] std::vector<std::size_t> shared_shift(const Scene& scene, const SteadyProblem& problem);

}  // namespace qdot
