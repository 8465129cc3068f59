#include "api/answers/answers.hpp"

#include <algorithm>
#include <cmath>

#include "api/answers/units_of.hpp"
#include "api/contract/version.hpp"
#include "core/dynamics/consistent_state.hpp"
#include "core/expr/parse.hpp"
#include "core/mechanics/moments.hpp"
#include "core/mechanics/restitution.hpp"

namespace qdot::api {

namespace {

bool is_valid(const Model& model, std::size_t parameter, const Reals& values) {
  return std::isfinite(values[parameter]) &&
         model.scene.parameters[parameter].domain.contains(values[parameter]);
}

/// A default that no value of the request stands in is the scene's own mistake.
[[noreturn]] void refuse_default(const Model& model, std::size_t parameter) {
  const std::string& name = model.scene.parameters[parameter].name;
  const Reals by_default = parameter_values(model, {});
  if (is_valid(model, parameter, by_default))
    throw Error(ErrorCode::invalid_parameters,
                "The default of " + name + " has no valid value here: give " + name + ".");
  throw SceneError({{"/parameters/" + std::to_string(parameter) + "/default", "domain",
                     "The default of " + name + " has no valid value: correct it, or give " + name +
                         " with the request."}});
}

}  // namespace

ResolvedState resolved_state(const Model& model, const SystemChoice& choice) {
  const RealValues parameters(choice.parameters.begin(), choice.parameters.end());
  const RealValues initial(choice.initial.begin(), choice.initial.end());
  ResolvedState state;
  state.parameters = parameter_values(model, parameters);
  for (std::size_t i = 0; i < state.parameters.size(); ++i) {
    if (!is_valid(model, i, state.parameters)) refuse_default(model, i);
  }
  refuse_wrong_restitutions(model.parsed, state.parameters);
  refuse_impossible_moments(model.parsed, state.parameters);
  state.y = initial_state(model, state.parameters, initial);
  for (std::size_t i = 0; i < state.y.size(); ++i) {
    if (std::isfinite(state.y[i])) continue;
    const std::string name = symbols(model.scene, SymbolRole::initial)[i].name;
    throw Error(ErrorCode::invalid_state,
                "The default of " + name + " has no finite value here: give " + name + ".");
  }
  return state;
}

namespace {

/// Which of (q, q') a request gives.
std::vector<bool> given_values(const Scene& scene, const SystemChoice& choice) {
  std::vector<bool> given;
  for (const Symbol& symbol : symbols(scene, SymbolRole::initial)) {
    given.push_back(
        std::ranges::any_of(choice.initial, [&](const auto& value) { return value.first == symbol.name; }));
  }
  return given;
}

}  // namespace

WrittenTexts written_texts(const SystemChoice& choice) {
  WrittenTexts texts;
  for (const auto& [name, text] : choice.written) {
    for (const SymbolRole role : {SymbolRole::parameter, SymbolRole::initial}) {
      for (const Symbol& symbol : symbols(*choice.scene, role)) {
        if (symbol.name == name) texts[name] = exact_quantity(text, symbol.unit);
      }
    }
  }
  return texts;
}

namespace {

/// The rational number that a parameter is by its text.
std::optional<Number> exact_parameter(const Model& model, const WrittenTexts& written, std::size_t i) {
  const auto text = written.find(model.scene.parameters[i].name);
  Graph graph;
  const Expression by_default = model.parsed.parameter_defaults[i];
  const auto given = text == written.end() ? std::nullopt : parse_all(text->second, graph, {}).expression;
  const Number* number = text == written.end() ? by_default.number() : given ? given->number() : nullptr;
  return number == nullptr ? std::nullopt : std::optional(*number);
}

ExponentValues known_exponents(const Model& model, const SystemChoice& choice, const std::string& varied) {
  ExponentValues known;
  if (model.parsed.exponents.names.empty()) return known;
  const WrittenTexts written = written_texts(choice);
  for (std::size_t i = 0; i < model.scene.parameters.size(); ++i) {
    const std::string& name = model.scene.parameters[i].name;
    if (name == varied || !model.parsed.exponents.names.contains(name)) continue;
    if (const auto value = exact_parameter(model, written, i)) known[name] = *value;
  }
  return known;
}

DefaultValues defaults_of(const Model& model) {
  DefaultValues defaults{*model.parsed.graph, {}, model.parsed.parameter_defaults};
  for (const Parameter& p : model.scene.parameters) defaults.names.push_back(p.name);
  return defaults;
}

/// The scene with the start that a request writes, whose momenta may follow the parameter that moves.
Scene scene_as_asked(const SystemChoice& choice, const std::string& varied) {
  Scene scene = *choice.scene;
  if (varied.empty()) return scene;
  const WrittenTexts written = written_texts(choice);
  for (Coordinate& q : scene.coordinates) {
    if (const auto text = written.find(q.name); text != written.end()) q.initial = text->second;
    if (const auto text = written.find(q.name + "_dot"); text != written.end()) q.initial_rate = text->second;
  }
  return scene;
}

}  // namespace

void put_in_exponents(ResolvedSystem& system, const SystemChoice& choice,
                      std::span<const std::string> events) {
  const auto has_power = [](const std::string& text) { return text.find('^') != std::string::npos; };
  if (std::ranges::none_of(events, has_power)) return;
  const WrittenTexts written = written_texts(choice);
  ExponentValues values;
  for (std::size_t i = 0; i < system.scene().parameters.size(); ++i) {
    if (const auto value = exact_parameter(system.model(), written, i))
      values[system.scene().parameters[i].name] = *value;
  }
  system.dynamics = Models::with_exponents(*system.dynamics, choice, std::move(values));
}

ResolvedSystem resolved_system(const SystemChoice& choice, Json echo, Models& models, std::optional<double> t,
                               const std::string& varied) {
  ResolvedSystem system{.dynamics = models.of(choice), .state = {}, .echo = std::move(echo)};
  system.state = resolved_state(system.model(), choice);
  const ExponentValues exponents = known_exponents(system.model(), choice, varied);
  const Followers followers =
      varied.empty() ? Followers{} : followers_of(defaults_of(system.model()), written_texts(choice), varied);
  const bool starts_elsewhere = !varied.empty() && !choice.initial.empty();
  if (!exponents.empty() || !followers.empty() || starts_elsewhere)
    system.dynamics = Models::of(choice, scene_as_asked(choice, varied), exponents, followers);
  if (t) {
    system.state.y = consistent_state(*system.dynamics, system.state.parameters, *t, system.state.y,
                                      given_values(system.scene(), choice));
  }
  Json& parameters = system.echo["parameters"] = Json::object();
  for (std::size_t i = 0; i < system.state.parameters.size(); ++i)
    parameters[system.scene().parameters[i].name] = system.state.parameters[i];
  system.echo["initial"] = state_json(system.scene(), system.state.y);
  return system;
}

Json state_json(const Scene& scene, std::span<const double> y) {
  const std::size_t n = scene.coordinates.size();
  Json json = Json::object();
  for (std::size_t i = 0; i < n; ++i) json[scene.coordinates[i].name] = y[i];
  for (std::size_t i = 0; i < n; ++i) json[scene.coordinates[i].name + "_dot"] = y[n + i];
  return json;
}

Json state_units(const Scene& scene) {
  Json units = Json::object();
  for (const Symbol& symbol : symbols(scene, SymbolRole::initial)) units[symbol.name] = symbol.unit;
  return units;
}

void write_head(JsonWriter& writer, const Scene& scene, const Json& echo,
                const std::vector<std::string>& notes) {
  writer.member("system", scene.name);
  writer.member("model_version", scene.model_version);
  writer.member("service_version", std::string(service_version()));
  writer.member("request", echo);
  if (!notes.empty()) writer.member("notes", notes);
}

Response written_answer(Call& call, const Scene& scene, const Json& echo, const Json& of_units,
                        std::optional<int> digits) {
  const Json without = scene.without_units ? with_units_of(scene, of_units) : Json();
  const Json& body = scene.without_units ? without : of_units;
  JsonWriter writer(call.layout, call.wanted);
  writer.begin_object();
  std::vector<std::string> notes = call.notes;
  if (const auto own = body.find("notes"); own != body.end())
    for (const Json& note : *own) notes.push_back(note.get<std::string>());
  write_head(writer, scene, echo, notes);
  for (const auto& [name, value] : body.items()) {
    if (name != "notes") writer.member(name, value, digits.value_or(shortest_digits));
  }
  writer.end_object();
  Response response{
      .status = 200, .content_type = "application/json", .headers = {}, .body = std::move(writer).finish()};
  call.timing.lap("encode");
  return response;
}

bool wants(const Call& call, std::string_view part) {
  return call.wanted == nullptr || std::ranges::find(*call.wanted, part) != call.wanted->end();
}

Road road_of(const Call& call) { return call.request.method == "POST" ? Road::body : Road::query; }

Response guarded(Call& call, const std::function<Response()>& answer) {
  try {
    return answer();
  } catch (const Error& error) {
    return to_response(problem_of(error, Place(road_of(call))), call.target.path, call.layout);
  }
}

}  // namespace qdot::api
