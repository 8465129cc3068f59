#include "api/answers/units_of.hpp"

namespace qdot::api {
namespace {

/// `json` is a unit, or all that stands in it are.
void drop_unit(Json& json) {
  if (json.is_structured()) {
    for (auto& part : json) drop_unit(part);
  } else if (json.is_string() && !is_text(json, "rad") && !is_text(json, "deg")) {
    json = "1";
  }
}

void drop_units(Json& json) {
  if (json.is_object()) {
    for (auto& [name, part] : json.items())
      name == "units" || name == "unit" ? drop_unit(part) : drop_units(part);
  } else if (json.is_array()) {
    for (Json& part : json) drop_units(part);
  }
}

}  // namespace

Json with_units_of(const Scene& scene, Json answer) {
  if (scene.without_units) drop_units(answer);
  return answer;
}

std::string key_beside(const Json& map, const std::string& place, const std::string& name) {
  return map.contains(name) ? place + "/" + name : name;
}

}  // namespace qdot::api
