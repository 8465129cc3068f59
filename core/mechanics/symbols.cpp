#include "core/mechanics/symbols.hpp"

#include <algorithm>

namespace qdot {

std::vector<Replacement> Symbols::rates() const {
  std::vector<Replacement> result;
  for (const Varying* varying : {&coordinates, &inputs, &held}) {
    for (std::size_t i = 0; i < varying->value.size(); ++i) {
      result.emplace_back(varying->value[i], varying->rate[i]);
      result.emplace_back(varying->rate[i], varying->second_rate[i]);
    }
  }
  result.emplace_back(t, t.graph().number(1));
  return result;
}

std::vector<std::string> momentum_names(const Symbols& symbols) {
  const auto name_of = [](const Expression& symbol) { return std::get<Symbol>(symbol.node()).name; };
  const auto is_taken = [&](const std::string& name) {
    const auto has = [&](const std::vector<Expression>& some) {
      return std::ranges::find(some, name, name_of) != some.end();
    };
    return has(symbols.parameters) || has(symbols.coordinates.value) || has(symbols.inputs.value) ||
           has(symbols.held.value) || has(symbols.multipliers);
  };
  std::vector<std::string> names;
  for (const Expression& q : symbols.coordinates.value) {
    std::string name = "p_" + name_of(q);
    for (std::string longer = "momentum_" + name_of(q); is_taken(name); longer += '_') name = longer;
    names.push_back(name);
  }
  return names;
}

}  // namespace qdot
