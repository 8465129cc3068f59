#pragma once
// What a scene may say: the fields of core/mechanics/scene.hpp, one table for each kind of object in it.

#include <string>
#include <vector>

#include "api/contract/table.hpp"
#include "api/json/json.hpp"
#include "core/mechanics/scene.hpp"

namespace qdot::api {

[[nodiscard]] const Table<Scene>& scene_table();

/// The lists whose entries have a `unit`; it is left out only in scenes without units.
[[nodiscard]] const std::vector<std::string>& lists_with_units();

/// The JSON Schema (2020-12) of a scene, which GET /v1/scene-schema shows.
[[nodiscard]] const Json& scene_schema();

}  // namespace qdot::api
