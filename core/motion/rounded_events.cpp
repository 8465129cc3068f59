#include "core/motion/rounded_events.hpp"

#include <algorithm>
#include <cmath>

#include "core/dynamics/watch.hpp"

namespace qdot {
namespace {

constexpr std::size_t rows_compared = 16;
constexpr double much_of_it = 0.1;

/// At the row where it is largest of some.
bool is_mostly_rounding(const Watch& watch, const ComputedMotion& motion) {
  const std::size_t rows = motion.simulation.rows, width = motion.width();
  const auto row = [&](std::size_t i) {
    return std::span(motion.simulation.states).subspan(i * width, width);
  };
  double largest = 0;
  std::size_t there = 0;
  for (std::size_t i = 0; i < rows; i += 1 + rows / rows_compared) {
    const double size = std::abs(watch.value(motion.grid.t[i], row(i)));
    if (size > largest) {
      largest = size;
      there = i;
    }
  }
  return largest > 0 && watch.own_rounding(motion.grid.t[there], row(there)) > much_of_it * largest;
}

}  // namespace

std::string event_lost_in_rounding(const ComputedMotion& motion) {
  const SimulationRequest& request = motion.request;
  if (request.events.empty()) return {};
  const std::vector<Watch> all = watches(motion.dynamics, {.parameters = request.parameters,
                                                           .events = request.events,
                                                           .on_invalid = OnInvalid::go_on,
                                                           .impacts = Impacts::ignore});
  for (const std::string& name : request.events) {
    const auto watch = std::ranges::find(all, name, &Watch::name);
    if (watch == all.end() || !is_mostly_rounding(*watch, motion)) continue;
    return "The numbers of which " + name +
           " is the difference are rounded by as much as it changes: how often it happens cannot be told.";
  }
  return {};
}

}  // namespace qdot
