#include "core/motion/unseen_flights.hpp"

#include <cmath>

#include "core/motion/pressing.hpp"
#include "core/numerics/constants.hpp"

namespace qdot {
namespace {

constexpr double goes_on = 0.999;  ///< of a rate
constexpr double changing = 2;     ///< forces change along a flight

}  // namespace

UnseenFlights::Left UnseenFlights::by_map(const Watch& watch, const SectionRecord& impact) const {
  const double after = std::abs(sides_.rate(watch, impact.t, impact.after).value);
  if (after <= rounding_of_rate(watch, impact)) return {};
  const double before = std::abs(sides_.rate(watch, impact.t, impact.before).value);
  return {after, before > 0 ? after / before : infinity};
}

double UnseenFlights::duration(const Watch& watch, const SectionRecord& impact, const Left& left) const {
  const double press = pressing(watch, impact, sections_, span_);
  if (press < 0) return infinity;
  if (left.rate == 0) return 0;
  if (press == 0 || !(left.ratio < goes_on)) return infinity;
  return changing * 2 * left.rate / (press * (1 - left.ratio));
}

}  // namespace qdot
