#include "api/scenes/scene_reader.hpp"

#include "api/contract/domain_text.hpp"
#include "api/contract/record_reader.hpp"
#include "api/scenes/scene_fields.hpp"
#include "api/scenes/scene_table.hpp"

namespace qdot {

void from_json(const api::Json& json, Position& position) {
  if (json.is_string()) {
    json.get_to(position.point);
  } else {
    json.get_to(position.components);
  }
}

void from_json(const api::Json& json, Domain& domain) {
  domain = api::parse_domain(json.get_ref<const std::string&>()).value();
}

}  // namespace qdot

namespace qdot::api {

SceneReading read_scene(const Json& json, const Place& place) {
  SceneReading reading;
  const RecordKind kind{&scene_table().set()};
  if (const auto resolved = read_value(kind, "scene", json, place, reading.errors)) {
    scene_table().store(*resolved, reading.scene);
  }
  return reading;
}

}  // namespace qdot::api
