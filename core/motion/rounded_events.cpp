#include "core/motion/rounded_events.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <vector>

#include "core/base/short_number.hpp"
#include "core/dynamics/watch.hpp"
#include "core/integrate/approaches.hpp"

namespace qdot {
namespace {

constexpr std::size_t rows_compared = 16;
constexpr double much_of_it = 0.1;

std::span<const double> row_of(const ComputedMotion& motion, std::size_t i) {
  return std::span(motion.simulation.states).subspan(i * motion.width(), motion.width());
}

/// The row where it is largest of some; none where it is 0 at all of them.
std::optional<std::size_t> row_of_largest(const Watch& watch, const ComputedMotion& motion) {
  const std::size_t rows = motion.simulation.rows;
  double largest = 0;
  std::optional<std::size_t> there;
  for (std::size_t i = 0; i < rows; i += 1 + rows / rows_compared) {
    const double size = std::abs(watch.value(motion.grid.t[i], row_of(motion, i)));
    if (size > largest) {
      largest = size;
      there = i;
    }
  }
  return there;
}

bool is_mostly_rounding(const Watch& watch, const ComputedMotion& motion) {
  const auto row = row_of_largest(watch, motion);
  if (!row) return false;
  const double t = motion.grid.t[*row], size = std::abs(watch.value(t, row_of(motion, *row)));
  return watch.own_rounding(t, row_of(motion, *row)) > much_of_it * size;
}

/// By more than what would be noted as near to zero (core/integrate/approaches.hpp).
bool is_off_by_much(const Watch& watch, const ComputedMotion& motion, std::span<const double> errors) {
  const auto row = row_of_largest(watch, motion);
  if (!row) return false;
  const double t = motion.grid.t[*row];
  std::vector<Interval> box;
  for (std::size_t k = 0; k < errors.size(); ++k) {
    const double y = row_of(motion, *row)[k];
    box.emplace_back(y - errors[k], y + errors[k]);
  }
  const Interval values = watch.enclosure(t, box);
  return values.is_finite() && values.radius() > near_zero * std::abs(watch.value(t, row_of(motion, *row)));
}

/// The names of events of which that is true.
template <class Property>
std::vector<std::string> events_that(const ComputedMotion& motion, const Property& property) {
  const SimulationRequest& request = motion.request;
  if (request.events.empty()) return {};
  const std::vector<Watch> all = watches(motion.dynamics, {.parameters = request.parameters,
                                                           .events = request.events,
                                                           .on_invalid = OnInvalid::go_on,
                                                           .impacts = Impacts::ignore});
  std::vector<std::string> names;
  for (const std::string& name : request.events) {
    const auto watch = std::ranges::find(all, name, &Watch::name);
    if (watch != all.end() && property(*watch)) names.push_back(name);
  }
  return names;
}

}  // namespace

std::vector<EventDoubt> events_lost_in_rounding(const ComputedMotion& motion) {
  std::vector<EventDoubt> found;
  for (const std::string& name :
       events_that(motion, [&](const Watch& watch) { return is_mostly_rounding(watch, motion); }))
    found.push_back(
        {name,
         "The numbers of which " + name +
             " is the difference are rounded by as much as it changes: how often it happens cannot be told."});
  return found;
}

std::vector<EventDoubt> events_hidden_by_rounding(const ComputedMotion& motion) {
  std::vector<EventDoubt> found;
  for (const auto& [name, from] : motion.simulation.untold)
    found.push_back({name, "From t = " + short_number(from, 6) +
                               " on rounding hides the sign of the function of " + name +
                               ": how often it happens there cannot be told."});
  return found;
}

std::vector<EventDoubt> events_lost_in_errors(const ComputedMotion& motion, std::span<const double> errors) {
  std::vector<EventDoubt> found;
  for (const std::string& name :
       events_that(motion, [&](const Watch& watch) { return is_off_by_much(watch, motion, errors); }))
    found.push_back({name, "The errors of the motion are a large part of what the function of " + name +
                               " is along it: how often it happens cannot be told."});
  return found;
}

std::vector<EventDoubt> events_that_may_be_several(const ComputedMotion& motion,
                                                   std::span<const std::optional<EventError>> errors) {
  std::vector<EventDoubt> found;
  for (std::size_t i = 0; i < errors.size(); ++i) {
    if (!errors[i] || errors[i]->is_single) continue;
    const EventRecord& event = motion.simulation.events[i];
    if (std::ranges::find(found, event.name, &EventDoubt::event) != found.end()) continue;
    found.push_back(
        {event.name, "At t = " + short_number(event.t, 6) + " the function of " + event.name +
                         " crosses zero so flatly that within the error of that time it may do so "
                         "several times."});
  }
  return found;
}

}  // namespace qdot
