#include "api/scenes/system_lookup.hpp"

#include <algorithm>
#include <iterator>

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
  report(errors, std::move(error));
  return nullptr;
}

std::shared_ptr<const Scene> carried(const Json& value, const Place& place, Errors& errors) {
  SceneReading reading = read_scene(value, place);
  if (reading.errors.empty()) return std::make_shared<const Scene>(std::move(reading.scene));
  std::ranges::move(reading.errors, std::back_inserter(errors));
  return nullptr;
}

}  // namespace

FindSystem find_system_in(const Catalogue& catalogue) {
  return [&catalogue](const Json& value, const Place& place, Errors& errors) -> std::shared_ptr<const Scene> {
    if (value.is_string()) return named(catalogue, value.get<std::string>(), place, errors);
    if (value.is_object()) return carried(value, place, errors);
    report(errors, place.error("wrong_type", "'system' needs the name of a system, or a scene."));
    return nullptr;
  };
}

}  // namespace qdot::api
