#include "core/turning/impacts_on_the_way.hpp"

#include <algorithm>

#include "core/compile/tape_evaluator.hpp"

namespace qdot {

std::vector<Column> impact_columns(const Model& model) {
  std::vector<Column> columns;
  const std::vector<SceneEvent>& events = model.scene.events;
  for (const ParsedImpact& impact : model.parsed.impacts) {
    const auto event = std::ranges::find(events, impact.event, &SceneEvent::name);
    const auto number = static_cast<std::size_t>(event - events.begin());
    columns.push_back({impact.event, "", model.parsed.events[number].value});
  }
  return columns;
}

std::string impact_that_depends(const std::vector<Column>& impacts, const std::vector<Expression>& symbols) {
  const auto it =
      std::ranges::find_if(impacts, [&](const Column& column) { return depends_on(column.value, symbols); });
  return it == impacts.end() ? "" : it->name;
}

std::string impact_along(EnclosedMotion& motion, const std::vector<Column>& impacts) {
  for (std::size_t i = 0; i < impacts.size(); ++i) {
    if (motion.vanishes(i) != Vanishes::never) return impacts[i].name;
  }
  return "";
}

std::string impact_within(const Dynamics& dynamics, const Reals& parameters, const Box& states,
                          const std::vector<Column>& impacts) {
  Box values(impacts.size());
  TapeEvaluator<Interval>(*dynamics.columns(impacts), parameters.as<Interval>())(states, values);
  for (std::size_t i = 0; i < impacts.size(); ++i) {
    if (!(values[i].lower > 0 || values[i].upper < 0)) return impacts[i].name;
  }
  return "";
}

}  // namespace qdot
