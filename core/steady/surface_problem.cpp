#include "core/steady/surface_problem.hpp"

namespace qdot {

SurfaceProblem surface_problem(const Dynamics& dynamics, const Reals& parameters, const Reals& y) {
  SurfaceProblem result{surface_statics(dynamics, parameters), {}, {}, {}};
  const SurfaceStatics& whole = result.whole;
  const std::vector<Interval> momenta = momenta_at(dynamics, *whole.statics, parameters, y);
  const VanishingMomenta those = vanishing_momenta(*whole.statics, momenta);
  refuse_dry_friction(*whole.dynamics, parameters, those.vanishing);
  result.steady = {whole.statics,
                   std::make_shared<const SteadyForces>(derive_surface_forces(whole, those.absent)),
                   parameters, parameters.as<Interval>()};
  result.steady.constants.insert(result.steady.constants.end(), momenta.begin(), momenta.end());
  result.constants = constants_on_surface(whole, dynamics, parameters, y);
  result.y.assign(y.begin(), y.begin() + static_cast<std::ptrdiff_t>(y.size() / 2));
  result.y.resize(2 * (y.size() / 2 + whole.constraints));
  return result;
}

}  // namespace qdot
