#include "api/scenes/system_lookup.hpp"

#include "api/json/text.hpp"
#include "api/scenes/scene_reader.hpp"

namespace qdot::api {
namespace {

std::shared_ptr<const Scene> named(const Catalogue& catalogue, const std::string& name, const Place& place,
                                   Errors& errors) {
  if (const CatalogueEntry* entry = catalogue.find(name)) {
    return {std::shared_ptr<void>(), &entry->scene};  // the catalogue owns it
  }
  FieldError error =
      unknown_name(place, "There is no system " + in_quotes(name) + ".", name, catalogue.names());
  error.code = "unknown_system";
  errors.push_back(std::move(error));
  return nullptr;
}

std::shared_ptr<const Scene> carried(const Json& value, const Place& place, Errors& errors) {
  SceneReading reading = read_scene(value);
  for (const Diagnostic& diagnostic : reading.diagnostics) {
    FieldError error = place.error(diagnostic.code, diagnostic.message);
    error.pointer += diagnostic.place;
    errors.push_back(std::move(error));
  }
  return reading.diagnostics.empty() ? std::make_shared<const Scene>(std::move(reading.scene)) : nullptr;
}

}  // namespace

FindSystem find_system_in(const Catalogue& catalogue) {
  return [&catalogue](const Json& value, const Place& place, Errors& errors) -> std::shared_ptr<const Scene> {
    if (value.is_string()) return named(catalogue, value.get<std::string>(), place, errors);
    if (value.is_object()) return carried(value, place, errors);
    errors.push_back(place.error("wrong_type", "'system' needs the name of a system, or a scene."));
    return nullptr;
  };
}

}  // namespace qdot::api
