#include "api/about/capabilities.hpp"

#include <optional>
#include <string>
#include <utility>
#include <variant>

#include "api/answers/endpoints.hpp"
#include "api/json/documents.hpp"
#include "api/json/writer.hpp"

namespace qdot::api {
namespace {

class Interview {
 public:
  Interview(std::string system, const Ask& ask) : system_(std::move(system)), ask_(ask) {}

  /// The answer, when the question applies.
  std::optional<Json> operator()(const Endpoint& endpoint, const Json& more) const {
    const Response response = ask_({.method = "POST",
                                    .target = address_of(endpoint),
                                    .headers = {{"content-type", "application/json"}},
                                    .body = to_text(body(more))});
    if (response.status != 200) return std::nullopt;
    return parse_json(response.body);
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

/// Everything that `include` can add to a trajectory.
Json all_extras(const Endpoint& simulate) {
  const FieldInfo* include = simulate.question.fields->find("include");
  return std::get<ChoiceKind>(*std::get<ListKind>(include->kind).element).options;
}

/// Name and unit of every column that a trajectory can have. They are read off the answer for a motion that
/// is too short to cost anything.
Json outputs_json(const Json& motion) {
  Json outputs = Json::array();
  for (const auto& [name, column] : motion["trajectory"].items())
    outputs.push_back({{"name", name}, {"unit", motion["units"][name]}});
  return outputs;
}

}  // namespace

Json capabilities_json(const CatalogueEntry& entry, const Ask& ask) {
  const Interview interview(entry.scene.name, ask);
  const Endpoint& simulate = *endpoint_at("/v1/simulate");
  const auto motion = interview(simulate, {{"t_end", 1e-6},
                                           {"samples", 2},
                                           {"include", all_extras(simulate)},
                                           {"on_invalid", "continue"},
                                           {"verify", false}});
  Json json{{"outputs", Json::array()}, {"capabilities", Json::array()}, {"examples", Json::array()}};
  if (motion) json["outputs"] = outputs_json(*motion);
  const Json parameters = motion ? (*motion)["request"]["parameters"] : Json::object();
  for (const Endpoint& endpoint : endpoints()) {
    const std::optional<Json> example = endpoint.example(entry.scene, parameters);
    if (!example || !interview(endpoint, *example)) continue;
    json["capabilities"].push_back(endpoint.name);
    json["examples"].push_back(
        {{"method", "POST"}, {"path", address_of(endpoint)}, {"body", interview.body(*example)}});
  }
  return json;
}

}  // namespace qdot::api
