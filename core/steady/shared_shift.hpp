#pragma once
// Equilibria that come in families because adding the same to several coordinates changes no force: carts on
// springs between them alone, disks on a shaft; or adding to each what is in a fixed ratio to the others:
// shafts joined by gears. None of them is a point that a search could isolate.

#include <string>
#include <vector>

#include "core/mechanics/scene.hpp"
#include "core/steady/steady_forces.hpp"
#include "core/steady/symmetric_changes.hpp"

namespace qdot {

/// The coordinates of one unit, by place in x, to which the same may be added; empty where that is not so
/// for those of any unit. Of all coordinates that forces depend on, and of scenes without kinks.
[[nodiscard]] std::vector<std::size_t> shared_shift(const Scene& scene, const SteadyProblem& problem);

/// What may be added to coordinates in a ratio of their own, by place in x: n to one while 1 to another.
/// Empty where no such thing was found, and where no force has to do with any of them; of scenes whose forces
/// are a potential's and have no kinks.
[[nodiscard]] WrittenChange shift_in_ratio(const SteadyProblem& problem);

}  // namespace qdot
