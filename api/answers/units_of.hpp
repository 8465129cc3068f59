#pragma once
// What answers say of units, where a scene has none.

#include "api/json/json.hpp"
#include "core/mechanics/scene.hpp"

namespace qdot::api {

/// An answer with its `units` and each `unit` as they are; of a scene without units only angles keep theirs.
[[nodiscard]] Json with_units_of(const Scene& scene, Json answer);

}  // namespace qdot::api
