#include "core/mechanics/restitution.hpp"

#include "core/base/error.hpp"
#include "core/expr/calculus.hpp"

namespace qdot {

double restitution_of(const ParsedImpact& impact, const ParsedScene& scene,
                      std::span<const double> parameters) {
  std::vector<Assignment> values;
  for (std::size_t i = 0; i < parameters.size(); ++i)
    values.emplace_back(scene.symbols.parameters[i], parameters[i]);
  return evaluate(*impact.contact->restitution, values);
}

void refuse_wrong_restitutions(const ParsedScene& scene, std::span<const double> parameters) {
  for (const ParsedImpact& impact : scene.impacts) {
    if (!impact.has_restitution()) continue;
    const double e = restitution_of(impact, scene, parameters);
    if (e >= 0 && e <= 1) continue;
    throw Error(ErrorCode::invalid_parameters,
                "The restitution at '" + impact.event +
                    "' is not between 0 and 1 with these parameters: bodies part with that share of the "
                    "speed with which they meet.");
  }
}

}  // namespace qdot
