#include "core/mechanics/moments.hpp"

#include <array>
#include <string>
#include <vector>

#include "core/base/error.hpp"
#include "core/expr/calculus.hpp"

namespace qdot {
namespace {

bool is_surely_negative(const Real& x) { return x.is_finite() && x.value + x.low + x.error < 0; }

std::string sentence(const ParsedBody& body, std::size_t k) {
  const std::string which = std::array{"first", "second", "third"}[k];
  const std::string whose = body.name.empty() ? "a body" : "'" + body.name + "'";
  return "the " + which + " principal moment of " + whose + " is larger than the sum of the other two";
}

}  // namespace

std::optional<std::string> impossible_moment(const ParsedScene& scene, const Reals& parameters) {
  std::vector<RealAssignment> values;
  for (std::size_t i = 0; i < parameters.size(); ++i)
    values.emplace_back(scene.symbols.parameters[i], parameters.exact(i));
  for (const ParsedBody& body : scene.bodies) {
    if (body.turns.empty() || body.spins.size() != 3) continue;
    for (std::size_t k = 0; k < 3; ++k) {
      const Expression rest = body.spins[(k + 1) % 3].inertia + body.spins[(k + 2) % 3].inertia;
      if (is_surely_negative(evaluate_exactly(rest - body.spins[k].inertia, values)))
        return sentence(body, k);
    }
  }
  return std::nullopt;
}

void refuse_impossible_moments(const ParsedScene& scene, const Reals& parameters) {
  if (const auto impossible = impossible_moment(scene, parameters))
    throw Error(ErrorCode::invalid_parameters,
                "With these parameters " + *impossible + ", which it is of no body.");
}

}  // namespace qdot
