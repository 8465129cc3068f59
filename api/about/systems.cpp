#include "api/about/systems.hpp"

#include "api/contract/json_schema.hpp"
#include "api/contract/system_choice.hpp"

namespace qdot::api {
namespace {

Json parameter_json(const Parameter& parameter) {
  Json json{{"name", parameter.name}, {"unit", parameter.unit}, {"default", parameter.default_value}};
  if (const Json domain = domain_json(parameter.domain); !domain.empty()) json["domain"] = domain;
  json["meaning"] = parameter.meaning;
  if (!parameter.latex.empty()) json["latex"] = parameter.latex;
  return json;
}

Json coordinate_json(const Coordinate& coordinate, const Symbol& velocity) {
  Json json{{"name", coordinate.name}, {"unit", coordinate.unit}, {"default", coordinate.initial}};
  json["velocity"] = {{"name", velocity.name}, {"unit", velocity.unit}, {"default", coordinate.initial_rate}};
  if (const Json domain = domain_json(coordinate.domain); !domain.empty()) json["domain"] = domain;
  json["meaning"] = coordinate.meaning;
  if (!coordinate.latex.empty()) json["latex"] = coordinate.latex;
  return json;
}

Json input_json(const Input& input) {
  return {{"name", input.name},
          {"unit", input.unit},
          {"default", input.default_value},
          {"meaning", input.meaning}};
}

template <class Items, class ToJson>
Json array_of(const Items& items, ToJson to_json) {
  Json array = Json::array();
  for (const auto& item : items) array.push_back(to_json(item));
  return array;
}

Json coordinates_json(const Scene& scene) {
  const std::vector<Symbol> known = symbols(scene, SymbolRole::initial);  // coordinates, then velocities
  const std::size_t count = scene.coordinates.size();
  Json array = Json::array();
  for (std::size_t i = 0; i < count; ++i)
    array.push_back(coordinate_json(scene.coordinates[i], known[count + i]));
  return array;
}

Json summary(const Scene& scene) {
  Json json{{"name", scene.name}, {"title", scene.title}};
  if (!scene.problem.empty()) json["problem"] = scene.problem;
  json["model_version"] = scene.model_version;
  json["href"] = "/v1/systems/" + scene.name;
  return json;
}

}  // namespace

Json system_list(const Catalogue& catalogue) {
  return {
      {"systems", array_of(catalogue.entries(), [](const CatalogueEntry& e) { return summary(e.scene); })}};
}

Json classics_list() {
  Json systems = Json::array();
  for (const std::string& name : classic_names()) systems.push_back(summary(read_classic(name)->scene));
  return {{"systems", std::move(systems)}};
}

Json system_description(const CatalogueEntry& entry, const Json& capabilities) {
  const Scene& scene = entry.scene;
  Json json = summary(scene);
  json["description"] = scene.description;
  json["parameters"] = array_of(scene.parameters, parameter_json);
  json["coordinates"] = coordinates_json(scene);
  json["inputs"] = array_of(scene.inputs, input_json);
  json["validity"] = array_of(scene.valid_while, [](const ValidityCondition& c) {
    return Json{{"name", c.name}, {"unit", c.unit}, {"reason", c.reason}, {"message", c.message}};
  });
  json["reports"] = array_of(scene.reports, [](const Report& r) {
    return Json{{"name", r.name}, {"unit", r.unit}, {"meaning", r.meaning}};
  });
  json["events"] = array_of(scene.events, [](const SceneEvent& e) {
    return Json{{"name", e.name}, {"meaning", e.meaning}};
  });
  json["has_impacts"] = scene.has_impacts();
  json.update(capabilities);
  json["scene"] = entry.json;
  return json;
}

}  // namespace qdot::api
