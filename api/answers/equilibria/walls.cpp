#include "api/answers/equilibria/walls.hpp"

#include <algorithm>
#include <vector>

#include "core/base/short_number.hpp"

namespace qdot::api {
namespace {

/// The events of impacts that return a speed, by number: their expressions are distances, which do not become
/// negative where they are met falling, or positive where rising.
std::vector<std::size_t> walls(const Model& model) {
  std::vector<std::size_t> found;
  for (std::size_t i = 0; i < model.scene.events.size(); ++i) {
    const SceneEvent& event = model.scene.events[i];
    const bool is_hit = std::ranges::any_of(model.parsed.impacts, [&](const ParsedImpact& impact) {
      return impact.event == event.name && impact.has_restitution();
    });
    if (is_hit && event.direction != Crossing::either &&
        !depends_on(model.parsed.events[i].value, model.parsed.symbols.t))
      found.push_back(i);
  }
  return found;
}

}  // namespace

std::string note_on_walls(const Model& model) {
  if (walls(model).empty()) return "";
  return "Places where the system rests pressed against what its impacts hit are not searched for.";
}

std::string wall_before(const Dynamics& dynamics, std::span<const double> parameters,
                        std::span<const double> y) {
  for (const std::size_t i : walls(dynamics.model())) {
    const SceneEvent& event = dynamics.model().scene.events[i];
    const qdot::Column distance{"", "", dynamics.model().parsed.events[i].value};
    const double there = values_at(dynamics, {distance}, parameters, 0, y)[0];
    if (event.direction == Crossing::falling ? there < 0 : there > 0)
      return "This place lies behind what the impact '" + event.name + "' hits: '" + event.expression +
             "' is " + short_number(there, 10) + " here.";
  }
  return "";
}

}  // namespace qdot::api
