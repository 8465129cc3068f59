#include "core/mechanics/symbols.hpp"

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

}  // namespace qdot
