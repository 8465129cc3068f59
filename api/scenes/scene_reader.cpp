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

namespace {

/// Of a scene without units.
void fill_units(Scene& scene) {
  const auto fill = [](auto& things) {
    for (auto& thing : things) {
      if (thing.unit.empty()) thing.unit = "1";
    }
  };
  fill(scene.parameters);
  fill(scene.coordinates);
  fill(scene.inputs);
  fill(scene.held_lengths);
  fill(scene.valid_while);
  fill(scene.reports);
}

/// A scene with units has them everywhere.
void check_units(const Json& scene, const Place& place, Errors& errors) {
  if (!scene.is_object() || is_text(scene.value("units", Json()), "none")) return;
  for (const std::string& list : lists_with_units()) {
    const auto found = scene.find(list);
    if (found == scene.end() || !found->is_array()) continue;
    for (std::size_t i = 0; i < found->size(); ++i) {
      const Json& entry = (*found)[i];
      if (!entry.is_object() || entry.contains("unit")) continue;
      report(errors, place.below(list).below(i).error("missing",
                                                      "'unit' is missing: 1 where there is none, or "
                                                      "\"units\": \"none\" for the whole scene."));
    }
  }
}

}  // namespace

SceneReading read_scene(const Json& json, const Place& place) {
  SceneReading reading;
  check_units(json, place, reading.errors);
  const RecordKind kind{&scene_table().set()};
  if (const auto resolved = read_value(kind, "scene", json, place, reading.errors)) {
    scene_table().store(*resolved, reading.scene);
    if (reading.scene.without_units) fill_units(reading.scene);
  }
  return reading;
}

}  // namespace qdot::api
