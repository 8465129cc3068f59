#include "core/gait/impact_functions.hpp"

#include <algorithm>

namespace qdot {
namespace {

std::vector<Expression> state_symbols(const Symbols& symbols) {
  std::vector<Expression> all = symbols.coordinates.value;
  all.insert(all.end(), symbols.coordinates.rate.begin(), symbols.coordinates.rate.end());
  return all;
}

/// The state after the impact, one expression a component; what the map does not name stays.
std::vector<Expression> jump_expressions(const ParsedScene& parsed) {
  std::vector<Expression> after = state_symbols(parsed.symbols);
  for (Expression& component : after) {
    for (const auto& [symbol, value] : parsed.impacts.front().map) {
      if (symbol == component) {
        component = value;
        break;
      }
    }
  }
  return after;
}

}  // namespace

const ParsedSceneEvent& impact_event(const Model& model) {
  const auto& events = model.scene.events;
  const auto found = std::ranges::find(events, model.parsed.impacts.front().event, &SceneEvent::name);
  return model.parsed.events[static_cast<std::size_t>(found - events.begin())];
}

ImpactFunctions impact_functions(const Dynamics& dynamics) {
  const Model& model = dynamics.model();
  Graph graph = *model.parsed.graph;
  const std::vector<Expression> symbols = state_symbols(model.parsed.symbols);
  std::vector<Eigen::Index> components;
  std::vector<Expression> jump, surface{graph.adopt(impact_event(model).value)};
  for (const Expression& e : jump_expressions(model.parsed)) jump.push_back(graph.adopt(e));
  const std::vector<Expression> after = jump;
  for (std::size_t i = 0; i < symbols.size(); ++i) {
    const Expression symbol = graph.adopt(symbols[i]);
    surface.push_back(differentiate(surface.front(), symbol));
    if (std::ranges::none_of(after, [&](const Expression& e) { return depends_on(e, symbol); })) continue;
    components.push_back(static_cast<Eigen::Index>(i));
    for (const Expression& e : after) jump.push_back(differentiate(e, symbol));
  }
  return {std::move(components), dynamics.compiled(graph, jump), dynamics.compiled(graph, surface)};
}

}  // namespace qdot
