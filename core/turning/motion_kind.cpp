#include "core/turning/motion_kind.hpp"

#include <cmath>

#include "core/base/short_number.hpp"

namespace qdot {
namespace {

constexpr double farthest_told = 1e140;  ///< the search ends at 1e150 (turning_search.cpp)

}  // namespace

Finding extremum_at(const MotionBound& bound, const std::string& name) {
  const double place = bound.place.middle();
  const std::string where = short_number(bound.place.contains(0.0) ? 0 : place, 10);
  const auto none = [](const std::string& reason) { return Finding{std::nullopt, 0, reason}; };
  switch (bound.kind) {
    case MotionBound::Kind::turning:
      if (bound.nearest) return {bound.nearest->value, bound.nearest->error, ""};
      return {place, bound.place.radius(), ""};
    case MotionBound::Kind::asymptote:
      return {place, bound.place.radius(),
              "The energy is that of a maximum of the effective potential there, as far as double precision "
              "tells: it is approached, not reached."};
    case MotionBound::Kind::full_turn:
      return none(name + " never turns: the kinetic energy stays positive over a whole turn.");
    case MotionBound::Kind::unbounded:
      return none(name + " never turns on this side: the kinetic energy stays positive all the way.");
    case MotionBound::Kind::domain_end:
      return none("The motion reaches the end of the range in which " + name + " describes a configuration.");
    case MotionBound::Kind::near_end:
      return none("The motion comes to rest at " + where +
                  ", to within rounding the end of the range in which " + name +
                  " describes a configuration: whether it turns before it is not known.");
    case MotionBound::Kind::fall:
      return none("At " + name + " = " + where + " the potential has a pole: " + name +
                  " does not turn before it, and towards it the speed grows without bound, as far as double "
                  "precision tells.");
    case MotionBound::Kind::no_value:
      return none(name + " does not turn before " + where +
                  ", where the potential ends or has no value that could be enclosed.");
    case MotionBound::Kind::no_inertia:
      return none(name + " does not turn before " + where +
                  ", where its inertia is zero to within rounding: towards it the speed grows without bound, "
                  "and no equation tells how a motion goes on.");
    case MotionBound::Kind::endless_inertia:
      return none(name + " does not turn before " + where +
                  ", where its inertia has no bound: no equation tells how a motion goes on.");
    case MotionBound::Kind::unresolved:
      break;
  }
  if (std::abs(place) > farthest_told)
    return none(name + " does not turn up to " + where +
                "; whether it turns beyond that cannot be told in "
                "double precision.");
  return none("Beyond " + where +
              " double precision cannot tell whether the motion turns; the potential is singular or almost "
              "flat there.");
}

std::string why_not_periodic(MotionKind kind) {
  switch (kind) {
    case MotionKind::separatrix:
      return "As far as double precision tells, the motion takes for ever to reach the maximum of the potential.";
    case MotionKind::equilibrium:
      return "The system stays at rest.";
    case MotionKind::unbounded:
    case MotionKind::libration:
    case MotionKind::rotation:
      break;
  }
  return "The motion does not come back.";
}

std::string why_rest_is_undecided(const std::string& name) {
  return "In double precision the force on " + name +
         " cannot be told from zero here, so neither can rest from a slow motion.";
}

}  // namespace qdot
