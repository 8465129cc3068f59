#include "core/motion/impact_map.hpp"

#include <algorithm>

namespace qdot {

ImpactMap impact_map(const Model& model, const ParsedImpact& impact) {
  const Symbols::Varying& q = model.parsed.symbols.coordinates;
  std::vector<Expression> state = q.value;
  state.insert(state.end(), q.rate.begin(), q.rate.end());
  ImpactMap map;
  for (const auto& [symbol, expression] : impact.map) {
    map.components.push_back({"", "", expression});
    map.places.push_back(static_cast<std::size_t>(std::ranges::find(state, symbol) - state.begin()));
  }
  return map;
}

}  // namespace qdot
