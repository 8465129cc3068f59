#pragma once
// What a scene may say: the fields of core/mechanics/scene.hpp, one table for each kind of object in it.

#include "api/contract/table.hpp"
#include "api/json/json.hpp"
#include "core/mechanics/scene.hpp"

namespace qdot::api {

[[nodiscard]] const Table<Scene>& scene_table();

/// The JSON Schema (2020-12) of a scene, which GET /v1/scene-schema shows.
[[nodiscard]] const Json& scene_schema();

}  // namespace qdot::api
