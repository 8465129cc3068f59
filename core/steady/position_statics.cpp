#include "core/steady/position_statics.hpp"

#include <algorithm>

#include "core/dynamics/consistent_state.hpp"

namespace qdot {
namespace {

bool fixes_unknown(const Dynamics& dynamics, const std::string& unknown) {
  const Lagrangian& lagrangian = dynamics.model().lagrangian;
  const auto is_unknown = [&](const Expression& p) { return std::get<Symbol>(p.node()).name == unknown; };
  const auto u = std::ranges::find_if(lagrangian.symbols.parameters, is_unknown);
  return u != lagrangian.symbols.parameters.end() &&
         std::ranges::any_of(lagrangian.constraints, [&](const ConstraintEquation& constraint) {
           return constraint.position && depends_on(*constraint.position, *u);
         });
}

}  // namespace

Reals with_unknown(const Scene& scene, const Reals& parameters, const std::string& unknown) {
  Reals result = parameters;
  for (std::size_t i = 0; i < result.size(); ++i) {
    if (scene.parameters[i].name == unknown) result.set(i, 1);
  }
  return result;
}

PositionStatics position_statics(const Dynamics& dynamics, const Reals& parameters) {
  if (!dynamics.model().has_constraints()) return {std::nullopt, std::nullopt, dynamics.statics(parameters)};
  PositionStatics result;
  result.surface = surface_statics(dynamics, parameters, RestingPlace::given);
  result.on_surface = derive_surface_forces(*result.surface, {});
  result.statics = result.surface->statics;
  return result;
}

Reals position_on_surface(const Dynamics& dynamics, const Reals& given_parameters, const Reals& y,
                          const std::vector<bool>& given, const std::string& unknown) {
  if (!dynamics.model().has_constraints()) return y;
  const Reals parameters = with_unknown(dynamics.model().scene, given_parameters, unknown);
  Reals at_rest = y;
  const SurfaceStatics whole = surface_statics(dynamics, parameters, RestingPlace::given);
  for (std::size_t k = 0; k < whole.coordinates; ++k)
    at_rest.set(given.size() + whole.statics->reduction.kept[k], 0);
  if (fixes_unknown(dynamics, unknown)) return at_rest;
  if (std::ranges::find(given, false) != given.end())
    return completed_state(dynamics, parameters, 0, at_rest, given);
  std::vector<bool> all(2 * given.size(), true);
  return consistent_state(dynamics, parameters, 0, at_rest, all);
}

std::size_t dependent_coordinates(const Dynamics& dynamics, const std::string& unknown) {
  const std::vector<ConstraintEquation>& constraints = dynamics.model().lagrangian.constraints;
  if (fixes_unknown(dynamics, unknown)) return 0;
  return static_cast<std::size_t>(std::ranges::count_if(
      constraints, [](const ConstraintEquation& constraint) { return constraint.position.has_value(); }));
}

}  // namespace qdot
