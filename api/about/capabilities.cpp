#include "api/about/capabilities.hpp"

#include <algorithm>
#include <optional>
#include <vector>

#include "api/json/writer.hpp"

namespace qdot::api {
namespace {

struct Example {
  const char* question;
  Json more;  ///< members beside `system`
};

/// An angle rather than a length.
std::string coordinate_that_turns(const Scene& scene) {
  const auto angle = std::ranges::find(scene.coordinates, "rad", &Coordinate::unit);
  return (angle == scene.coordinates.end() ? scene.coordinates.front() : *angle).name;
}

/// Equilibria as a parameter moves around its default: a speed of rotation where there is one.
std::optional<Json> moving_parameter(const Scene& scene, const Json& values) {
  const Parameter* moving = nullptr;
  for (const Parameter& parameter : scene.parameters) {
    if (values.value(parameter.name, 0.0) == 0) continue;
    if (moving == nullptr || parameter.unit == "rad/s") moving = &parameter;
  }
  if (moving == nullptr) return std::nullopt;
  const double value = values[moving->name];
  return Json{{"parameter", moving->name}, {"from", value / 2}, {"to", 2 * value}};
}

std::vector<Example> examples_for(const Scene& scene, const Json& values) {
  std::vector<Example> examples{
      {"equations", Json::object()},
      {"energy", Json::object()},
      {"modes", Json::object()},
      {"equilibria", Json::object()},
      {"turning_points", {{"coordinate", coordinate_that_turns(scene)}, {"t_end", 10}}},
      {"gait", Json::object()},
      {"simulate", {{"t_end", 10}}},
      {"accuracy", {{"t_end", 1}}}};
  if (auto moving = moving_parameter(scene, values)) examples.push_back({"bifurcations", std::move(*moving)});
  return examples;
}

class Interview {
 public:
  Interview(std::string system, const Ask& ask) : system_(std::move(system)), ask_(ask) {}

  /// The answer, when the question applies.
  std::optional<Json> operator()(const char* question, const Json& more) const {
    const Response response = ask_({.method = "POST",
                                    .target = std::string("/v1/") + question,
                                    .headers = {{"content-type", "application/json"}},
                                    .body = to_text(body(more))});
    if (response.status != 200) return std::nullopt;
    return Json::parse(response.body);
  }

  [[nodiscard]] Json body(const Json& more) const {
    Json body{{"system", system_}};
    body.update(more);
    return body;
  }

 private:
  std::string system_;
  const Ask& ask_;
};

/// Every column there is, from a motion of no account.
Json outputs_json(const Json& motion) {
  Json outputs = Json::array();
  for (const auto& [name, column] : motion["trajectory"].items())
    outputs.push_back({{"name", name}, {"unit", motion["units"][name]}});
  return outputs;
}

}  // namespace

Json capabilities_json(const CatalogueEntry& entry, const Ask& ask) {
  const Interview interview(entry.scene.name, ask);
  const Json include{"energy", "momenta", "positions", "accelerations", "validity"};
  const auto motion = interview(
      "simulate",
      {{"t_end", 1e-6}, {"samples", 2}, {"include", include}, {"on_invalid", "continue"}, {"verify", false}});
  Json json{{"outputs", Json::array()}, {"capabilities", Json::array()}, {"examples", Json::array()}};
  if (motion) json["outputs"] = outputs_json(*motion);
  const Json values = motion ? (*motion)["request"]["parameters"] : Json::object();
  for (const auto& [question, more] : examples_for(entry.scene, values)) {
    if (!interview(question, more)) continue;
    json["capabilities"].push_back(question);
    json["examples"].push_back(
        {{"method", "POST"}, {"path", std::string("/v1/") + question}, {"body", interview.body(more)}});
  }
  return json;
}

}  // namespace qdot::api
