#include "api/scenes/system_lookup.hpp"

#include <algorithm>
#include <iterator>

#include "api/json/text.hpp"
#include "api/scenes/scene_reader.hpp"

namespace qdot::api {
namespace {

/// "4" is the number of a problem on the practice sheet.
std::string system_of_problem(const Catalogue& catalogue, const std::string& number) {
  for (const CatalogueEntry& entry : catalogue.entries()) {
    if (!number.empty() && entry.scene.problem == number) return entry.scene.name;
  }
  return {};
}

std::shared_ptr<const Scene> named(const Catalogue& catalogue, const std::string& name, const Place& place,
                                   Errors& errors) {
  if (const auto entry = catalogue.find_anywhere(name)) return {entry, &entry->scene};
  std::vector<std::string> all = catalogue.names();
  std::ranges::move(classic_names(), std::back_inserter(all));
  const std::string_view bare = std::string_view(name).substr(0, name.rfind(".json"));
  FieldError error =
      unknown_name(place, "There is no system " + in_quotes(name) + ".", std::string(bare), all);
  error.code = "unknown_system";
  if (const std::string meant = system_of_problem(catalogue, name); !meant.empty())
    error.did_you_mean = meant;
  if (name.find_first_of(";,&?=") != std::string::npos)
    error.detail += " In a query, & stands between one name=value and the next.";
  report(errors, std::move(error));
  return nullptr;
}

void report_missing(const Catalogue& catalogue, const Place& place, Errors& errors) {
  FieldError error = place.error("missing", "'system' is missing: the name of a system, or a scene.");
  error.allowed = catalogue.names();
  report(errors, std::move(error));
}

/// {"name": "cart_pendulum"} and nothing of a scene: the name alone was meant.
bool only_names(const Json& value) {
  const auto name = value.find("name");
  return name != value.end() && name->is_string() && !value.contains("coordinates") &&
         !value.contains("bodies") && !value.contains("lagrangian");
}

std::shared_ptr<const Scene> carried(const Catalogue& catalogue, const Json& value, const Place& place,
                                     Errors& errors) {
  if (only_names(value)) {
    const auto& name = value["name"].get_ref<const std::string&>();
    Errors of_name;
    if (named(catalogue, name, place, of_name) != nullptr) {
      FieldError error = place.error(
          "wrong_type", "A system that is there already is given by its name alone, \"system\": \"" + name +
                            "\"; values stand beside it, in 'parameters' and 'initial'.");
      error.did_you_mean = name;
      report(errors, std::move(error));
      return nullptr;
    }
  }
  SceneReading reading = read_scene(value, place);
  if (reading.errors.empty()) return std::make_shared<const Scene>(std::move(reading.scene));
  std::ranges::move(reading.errors, std::back_inserter(errors));
  return nullptr;
}

}  // namespace

FindSystem find_system_in(const Catalogue& catalogue) {
  return [&catalogue](const Json& value, const Place& place, Errors& errors) -> std::shared_ptr<const Scene> {
    if (value.is_string()) return named(catalogue, value.get<std::string>(), place, errors);
    if (value.is_object()) return carried(catalogue, value, place, errors);
    if (value.is_null()) {
      report_missing(catalogue, place, errors);
      return nullptr;
    }
    report(errors, place.error("wrong_type", "'system' needs the name of a system, or a scene."));
    return nullptr;
  };
}

}  // namespace qdot::api
