#pragma once
// What answers say of units, where a scene has none.

#include <string>

#include "api/json/json.hpp"
#include "core/mechanics/scene.hpp"

namespace qdot::api {

/// An answer with its `units` and each `unit` as they are; of a scene without units only angles keep theirs.
[[nodiscard]] Json with_units_of(const Scene& scene, Json answer);

/// The key for `name` in a flat map, such as `units`, of what stands under `place` in the answer: the name,
/// or "multipliers/T" where the map has another thing of that name.
[[nodiscard]] std::string key_beside(const Json& map, const std::string& place, const std::string& name);

}  // namespace qdot::api
